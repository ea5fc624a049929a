//! Plots of the tables that accompany the pages.

use super::axis::{Axis, Unit};
use super::chart::{Chart, Place, Series};
use super::look::{Look, Mark};
use crate::number::digits;
use crate::report::measured::Table;

/// Returns the plots of a table, by its name. None for an unknown name or other columns.
#[must_use]
pub fn charts(table: &Table) -> Vec<Chart> {
    match table.name {
        "filters" => vec![filters(table)],
        "tables" => vec![tables(table)],
        "cells" => cells(table, ["quads", "grid s"]),
        "tessellation" => cells(table, ["quads", "grid_s"]),
        _ => Vec::new(),
    }
    .into_iter()
    .filter(|chart| chart.series.iter().any(|series| !series.places.is_empty()))
    .collect()
}

/// Makes a chart of curves, with axes that fit all points.
fn chart(title: &str, across: (&str, Unit), up: (&str, Unit), series: Vec<Series>) -> Chart {
    let axis = |(label, unit): (&str, Unit), of: fn(&Place) -> f64| {
        Axis::around(label, unit, series.iter().flat_map(|own| &own.places).map(of))
    };
    let (across, up) = (axis(across, |place| place.x), axis(up, |place| place.y));
    let title = Some(title.into());
    Chart { title, across, up, series, band: None, front: Vec::new(), key: Vec::new() }
}

/// Returns the points of rows. The name of each point begins with the row's first cell.
fn places<'a>(
    table: &Table,
    rows: impl Iterator<Item = &'a Vec<String>>,
    [x, y]: [&str; 2],
) -> Vec<Place> {
    rows.filter_map(|row| {
        let (x, y) = (table.number(row, x)?, table.number(row, y)?);
        let name = format!("{}: {}, {}", row.first()?, digits(x, 3), digits(y, 2));
        Some(Place { x, y, name, note: None })
    })
    .collect()
}

/// Plots error against time of one average. A line joins the numbers of samples in a pixel.
fn filters(table: &Table) -> Chart {
    let columns = |error| ["ratio", error];
    let samples = |row: &&Vec<String>| row[0].starts_with("bilinear");
    let mut joined = places(table, table.rows.iter().filter(samples), columns("rms box"));
    for (place, row) in joined.iter_mut().zip(table.rows.iter().filter(samples)) {
        let rays = row[0].trim_start_matches("bilinear").trim_start_matches(", ");
        place.note = Some(rays.split(' ').next().filter(|n| !n.is_empty()).unwrap_or("1").into());
    }
    let mut series = vec![Series {
        name: "bilinear".into(),
        look: Look::number(1),
        joined: true,
        places: joined,
    }];
    // Filters have their look of the other plots. The box of one pixel has the look of the box, but
    // hollow.
    for (name, look) in [
        ("point", Look::number(0)),
        ("mip", Look::number(2)),
        ("box", Look::number(3)),
        ("tent", Look::number(4)),
        ("quadratic", Look::number(5)),
        ("box, 1 px", Look::number(3).hollow()),
    ] {
        let own = || table.rows.iter().filter(move |row| row[0] == name);
        let places = places(table, own(), columns("rms box"));
        series.push(Series { name: name.into(), look, joined: false, places });
    }
    chart(
        "One average, without its ray: error against time",
        ("time by that of bilinear interpolation", Unit::Plain),
        ("RMS error against the pixel's box, of white", Unit::Plain),
        series,
    )
}

/// Plots the rounding error of averages against the side of the box, by order and number type.
fn tables(table: &Table) -> Chart {
    let mut kinds: Vec<[&str; 2]> = Vec::new();
    let kind = |row: &'_ Vec<String>| -> Option<[String; 2]> {
        Some([table.cell(row, "order")?.into(), table.cell(row, "word")?.into()])
    };
    for row in &table.rows {
        if let (Some(order), Some(word)) = (table.cell(row, "order"), table.cell(row, "word"))
            && !kinds.contains(&[order, word])
        {
            kinds.push([order, word]);
        }
    }
    let marks = [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond, Mark::Wedge];
    let mut words: Vec<&str> = Vec::new();
    let mut series = Vec::new();
    for [order, word] in kinds {
        if !words.contains(&word) {
            words.push(word);
        }
        let at = words.iter().position(|known| *known == word).unwrap_or(0);
        let color = order.parse::<usize>().unwrap_or(0) + 2;
        let look = Look { mark: marks[at % marks.len()], ..Look::number(color) };
        let own = |row: &&Vec<String>| kind(row).is_some_and(|own| own == [order, word]);
        let columns = ["box side in texels", "rms error"];
        let mut places = places(table, table.rows.iter().filter(own), columns);
        places.retain(|place| place.y > 0.0);
        let word = word.split(',').next().unwrap_or(word);
        series.push(Series { name: format!("{word}, n = {order}"), look, joined: true, places });
    }
    chart(
        "Rounding of averages, by order and word; without a curve there is none",
        ("side of the box, in texels", Unit::Plain),
        ("RMS error, of white", Unit::Plain),
        series,
    )
}

/// Plots quads and time of meshes against the distance that they reach. Lines of even cells are dashed.
fn cells(table: &Table, taken: [&str; 2]) -> Vec<Chart> {
    let mut shapes: Vec<&str> = Vec::new();
    for row in &table.rows {
        if let Some(shape) = table.cell(row, "shape").filter(|shape| !shapes.contains(shape)) {
            shapes.push(shape);
        }
    }
    let is = |row: &[String], column: &str, cell: &str| table.cell(row, column) == Some(cell);
    let even = |row: &[String]| is(row, "cells", "even") || is(row, "cells", "uniform");
    let what = [("quads", Unit::Plain), ("time of the grid", Unit::Seconds)];
    let charts = taken.into_iter().zip(what).map(|(column, up)| {
        let mut series = Vec::new();
        for (k, &shape) in shapes.iter().enumerate() {
            for is_even in [true, false] {
                let rows = table.rows.iter();
                let own = rows.filter(|row| is(row, "shape", shape) && even(row) == is_even);
                let look = Look::number(k + 1);
                let look = if is_even { look.hollow().dashed() } else { look };
                let name = if is_even { String::new() } else { shape.into() };
                let places = places(table, own, ["reached", column]);
                series.push(Series { name, look, joined: true, places });
            }
        }
        let title = format!("{} against the distance reached", up.0);
        let across = ("largest distance to the surface", Unit::Plain);
        let key = vec![(Look::number(1).hollow(), "dashed: even cells".to_string())];
        Chart { key, ..chart(&title, across, up, series) }
    });
    charts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::table;

    #[test]
    fn samples_are_joined_and_filters_stand_by_themselves() {
        let rows = ["tent,12,0.07", "bilinear,1,0.25", "\"bilinear, 2 x 2\",5,0.13"];
        let mut filters = table("filters", "method,ratio,rms box", &rows[..2]);
        filters.rows.push(["bilinear, 2 x 2", "5", "0.13"].map(str::to_string).into());
        let [chart] = &charts(&filters)[..] else { panic!("one chart") };
        let notes: Vec<_> = chart.series[0].places.iter().map(|p| p.note.as_deref()).collect();
        assert_eq!(notes, [Some("1"), Some("2")]);
        assert_eq!(chart.series.iter().filter(|own| !own.places.is_empty()).count(), 2);
    }

    #[test]
    fn words_without_an_error_have_no_curve() {
        let rows = ["1,f32,2,1e-5,1e-4", "1,f32,8,2e-6,1e-5", "1,u64,2,0,0", "2,f32,2,1e-3,1e-2"];
        let own = table("tables", "order,word,box side in texels,rms error,largest error", &rows);
        let [chart] = &charts(&own)[..] else { panic!("one chart") };
        let lengths: Vec<_> = chart.series.iter().map(|own| own.places.len()).collect();
        assert_eq!(lengths, [2, 0, 1]);
    }

    #[test]
    fn every_shape_has_two_curves_in_each_of_two_charts() {
        let rows = ["horn,even,0.01,700,0.1", "horn,where it bends,0.01,400,0.1"];
        let own = table("cells", "shape,cells,reached,quads,grid s", &rows);
        let charts = charts(&own);
        assert_eq!(charts.len(), 2);
        for chart in charts {
            assert!(chart.series.iter().all(|own| own.places.len() == 1));
            assert_eq!(chart.series.len(), 2);
        }
    }

    #[test]
    fn other_tables_have_none() {
        assert!(charts(&table("mapping", "class,median", &["a,1"])).is_empty());
        assert!(charts(&table("cells", "none", &["a"])).is_empty());
    }
}
