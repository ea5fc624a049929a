//! Reads JSON objects whose keys are names that a user chose.

use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

/// Reads a map and refuses a name that occurs twice. The maps of serde would keep the last value.
///
/// # Errors
/// When a name occurs for the second time.
pub fn each_name_once<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<BTreeMap<String, T>, D::Error> {
    deserializer.deserialize_map(NamesVisitor(PhantomData))
}

struct NamesVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for NamesVisitor<T> {
    type Value = BTreeMap<String, T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of named values")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        let mut named = BTreeMap::new();
        while let Some((name, value)) = entries.next_entry::<String, T>()? {
            if named.contains_key(&name) {
                return Err(de::Error::custom(format!("duplicate key `{name}`")));
            }
            named.insert(name, value);
        }
        Ok(named)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<BTreeMap<String, u32>, String> {
        let mut reader = serde_json::Deserializer::from_str(text);
        each_name_once(&mut reader).map_err(|error| error.to_string())
    }

    #[test]
    fn a_name_that_comes_twice_is_refused() {
        assert_eq!(read("{\"a\": 1, \"b\": 2}").unwrap().len(), 2);
        assert!(read("{\"a\": 1, \"a\": 2}").unwrap_err().contains("duplicate key `a`"));
    }
}
