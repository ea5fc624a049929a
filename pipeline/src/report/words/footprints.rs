//! Sentences on footprints that are hard for the thesis's method: slanted or thin ones.

use super::super::measured::Table;
use super::numbers::list;
use super::{AS_NEAR, Claim, Topic, Verdict, nearer};
use crate::number::{error, times};

/// Returns the sentences that the table of filters on a floor supports.
pub fn claims(floor: &Table) -> Vec<Claim> {
    let rotated = hard(
        floor,
        Topic::Rotated,
        ["rms 0 deg", "rms 45 deg"],
        ["Where footprints lie along the texture", "where they lie at 45 degrees to it"],
    );
    let thin = hard(
        floor,
        Topic::Thin,
        ["rms from 2 texels", "rms below 1 texel"],
        [
            "Where the short side of a pixel's piece of texture is two texels or more",
            "where it is less than one texel",
        ],
    );
    [rotated, thin].into_iter().flatten().collect()
}

/// Returns a sentence on the tent's error for easy and for hard footprints, with methods that are
/// nearer for the hard ones.
fn hard(floor: &Table, topic: Topic, columns: [&str; 2], places: [&str; 2]) -> Option<Claim> {
    let number = |row: &[String], column: &str| floor.number(row, column);
    let own = floor.row("tent")?;
    let [easy, hard] = columns.map(|column| number(own, column));
    let (easy, hard) = (easy?, hard?);
    let rivals = |column: &str, own: f64| -> Vec<&[String]> {
        let mut rivals: Vec<&[String]> = floor
            .rows
            .iter()
            .map(Vec::as_slice)
            .filter(|row| row[0] == "mip" || row[0].starts_with("bilinear"))
            .filter(|row| number(row, column).is_some_and(|error| nearer(error, own)))
            .collect();
        // Cheap methods come first. Two of them are enough to make the point.
        rivals.sort_by(|a, b| {
            let [a, b] = [a, b].map(|row| number(row, "ns").unwrap_or(f64::INFINITY));
            a.total_cmp(&b)
        });
        rivals.truncate(2);
        rivals
    };
    let beaten = rivals(columns[1], hard);
    let names: Vec<String> = beaten
        .iter()
        .filter_map(|row| {
            let [there, else_] = [columns[1], columns[0]].map(|column| number(row, column));
            Some(format!("{} ({}, and {} on the others)", row[0], error(there?), error(else_?)))
        })
        .collect();
    let mut text = format!("{} the tent is {} off", places[0], error(easy));
    let ratio = hard / easy;
    let verdict = if ratio > AS_NEAR {
        text += &format!(", {} {}, {} times as far", places[1], error(hard), times(ratio));
        Verdict::Loses
    } else {
        text += &format!(", {} no farther ({})", places[1], error(hard));
        if names.is_empty() { Verdict::Wins } else { Verdict::Loses }
    };
    text += &match names.is_empty() {
        true => "; of what has no tables nothing is nearer there".to_string(),
        false => format!(
            "; there {} {} nearer",
            list(&names),
            if names.len() == 1 { "is" } else { "are" }
        ),
    };
    text += ". (One average each, on a floor in perspective; see the filters by themselves.)";
    Some(Claim::general(topic, verdict, text))
}
