//! The pieces of a Bezier curve as they are read: four points each.

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;

/// The four points of a piece. Another number of points has an error message of its own.
struct Piece<P>([P; 4]);

impl<'de, P: Deserialize<'de>> Deserialize<'de> for Piece<P> {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        struct Visit<P>(PhantomData<P>);
        impl<'de, P: Deserialize<'de>> Visitor<'de> for Visit<P> {
            type Value = Piece<P>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a piece of four points")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut points: A) -> Result<Piece<P>, A::Error> {
                let mut read = Vec::with_capacity(4);
                while let Some(point) = points.next_element()? {
                    read.push(point);
                }
                let count = read.len();
                read.try_into().map(Piece).map_err(|_| {
                    A::Error::custom(format!(
                        "found {count} points, expected four per piece: its ends and two handles; the next piece starts \
                         where this one ends"
                    ))
                })
            }
        }
        reader.deserialize_seq(Visit(PhantomData))
    }
}

/// Reads the pieces of a curve.
pub(super) fn read<'de, P, D>(reader: D) -> Result<Vec<[P; 4]>, D::Error>
where
    P: Deserialize<'de>,
    D: Deserializer<'de>,
{
    let pieces: Vec<Piece<P>> = Deserialize::deserialize(reader)?;
    Ok(pieces.into_iter().map(|piece| piece.0).collect())
}
