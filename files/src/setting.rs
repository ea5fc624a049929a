//! Values of a JSON file that a command line sets: `-D camera.fov_deg=35 -D objects[0].sphere.radius=2`.
//!
//! A setting changes the text of the file before the text is read. So a value that is set is checked like a value
//! that was written in the file, and messages about other values keep their positions, unless a setting before them
//! in the same line changes its length.

use crate::{Exit, Failure, words};
use jsonc_parser::ast::{Object, Value};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use std::str::FromStr;
use thiserror::Error;

/// A value, and the path of its place in a JSON file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// The argument, as the user wrote it.
    argument: String,
    steps: Vec<Step>,
    /// The value as JSON text.
    value: String,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Step {
    Key(String),
    Index(usize),
}

/// A setting that its file has no place for.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("-D {argument}: {file}: {message}")]
pub struct SettingError {
    argument: String,
    file: String,
    message: String,
}

impl Failure for SettingError {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

impl FromStr for Setting {
    type Err = String;

    /// Reads `PATH=VALUE`. A value that is not JSON is a string: `-D objects[0].material=glass`.
    fn from_str(argument: &str) -> Result<Self, String> {
        const EXPECTED: &str =
            "expected PATH=VALUE, such as camera.fov_deg=35 or objects[0].sphere.radius=2";
        let (path, value) = argument.split_once('=').ok_or(EXPECTED)?;
        let mut steps = Vec::new();
        for part in path.split('.') {
            let (key, indices) = part.split_once('[').unwrap_or((part, ""));
            if key.is_empty() {
                return Err(EXPECTED.into());
            }
            steps.push(Step::Key(key.into()));
            if indices.is_empty() && part.len() == key.len() {
                continue;
            }
            let indices = indices.strip_suffix(']').ok_or(EXPECTED)?;
            for index in indices.split("][") {
                steps.push(Step::Index(index.parse().map_err(|_| EXPECTED)?));
            }
        }
        let is_json = serde_json::from_str::<serde::de::IgnoredAny>(value).is_ok();
        let value = match is_json {
            true => value.into(),
            false => serde_json::Value::from(value).to_string(),
        };
        Ok(Self { argument: argument.into(), steps, value })
    }
}

impl Setting {
    /// Returns the argument as the user wrote it.
    #[must_use]
    pub fn argument(&self) -> &str {
        &self.argument
    }

    /// Returns the setting as `PATH=VALUE`, with the value as JSON.
    #[must_use]
    pub fn text(&self) -> String {
        format!("{}={}", path_of(&self.steps), self.value)
    }

    /// Returns the setting without its first key, if that is `key`: `camera.fov_deg=35` of `scene.camera.fov_deg=35`.
    #[must_use]
    pub fn below(&self, key: &str) -> Option<Self> {
        match self.steps.split_first()? {
            (Step::Key(first), rest)
                if first == key && matches!(rest.first(), Some(Step::Key(_))) =>
            {
                Some(Self { steps: rest.to_vec(), ..self.clone() })
            }
            _ => None,
        }
    }

    /// Returns the text with the value in its place. Keys that are missing on the path are added, and the reader of the
    /// text judges them.
    fn set(&self, file: &str, text: &str) -> Result<String, SettingError> {
        let parsed = parse_to_ast(text, &CollectOptions::default(), &ParseOptions::default());
        let Ok(Some(root)) = parsed.map(|parsed| parsed.value) else {
            // The reader says what is wrong with the text.
            return Ok(text.into());
        };
        let mut place = &root;
        for (number, step) in self.steps.iter().enumerate() {
            let next = match (place, step) {
                (Value::Object(object), Step::Key(key)) => {
                    let property = object.properties.iter().rfind(|one| one.name.as_str() == key);
                    let Some(property) = property else {
                        return self.added(file, text, object, number);
                    };
                    Some(&property.value)
                }
                (Value::Array(array), Step::Index(index)) => {
                    let count = array.elements.len();
                    if *index >= count {
                        let list = self.path(number);
                        let message = format!(
                            "found {list}[{index}], expected a number below {count}, the length of the list"
                        );
                        return Err(self.error(file, message));
                    }
                    array.elements.get(*index)
                }
                _ => None,
            };
            let Some(next) = next else {
                let (found, expected) = match (place, step) {
                    (Value::Array(_), _) => ("a list", "the number of an element, as in [0]"),
                    (Value::Object(_), _) => ("an object", "the name of a key"),
                    _ => ("a single value", "a path that ends here"),
                };
                let message =
                    format!("found {found} at {}, expected {expected}", self.path(number));
                return Err(self.error(file, message));
            };
            place = next;
        }
        Ok(format!("{}{}{}", &text[..place.start()], self.value, &text[place.end()..]))
    }

    /// Returns the text with the value in an object that has no key of the step with this number.
    fn added(
        &self,
        file: &str,
        text: &str,
        object: &Object<'_>,
        number: usize,
    ) -> Result<String, SettingError> {
        let mut value = self.value.clone();
        for step in self.steps[number..].iter().rev() {
            match step {
                Step::Key(key) => {
                    let key = serde_json::Value::from(key.as_str());
                    value = format!("{{{key}: {value}}}");
                }
                Step::Index(_) => {
                    let message = format!("found no list {}", self.path(number + 1));
                    let message = format!("{message}, expected one to change an element of");
                    return Err(self.error(file, message));
                }
            }
        }
        let pair = &value[1..value.len() - 1];
        let (at, comma) = match object.properties.last() {
            Some(last) => (last.end(), ", "),
            None => (object.start() + 1, ""),
        };
        Ok(format!("{}{comma}{pair}{}", &text[..at], &text[at..]))
    }

    /// Returns the path of the first steps, as messages show it.
    fn path(&self, steps: usize) -> String {
        let path = path_of(&self.steps[..steps]);
        if path.is_empty() { "the root".into() } else { words::shortened(&path) }
    }

    fn error(&self, file: &str, message: String) -> SettingError {
        let argument = words::shortened(&self.argument);
        SettingError { argument, file: file.into(), message }
    }
}

/// Returns a path as text, such as `objects[0].place`.
fn path_of(steps: &[Step]) -> String {
    let mut path = String::new();
    for step in steps {
        match step {
            Step::Key(key) if path.is_empty() => path.push_str(key),
            Step::Key(key) => path.push_str(&format!(".{key}")),
            Step::Index(index) => path.push_str(&format!("[{index}]")),
        }
    }
    path
}

/// Returns the text of a JSON file with its settings applied one after another. A text that is not JSON stays as it is,
/// since its reader says what is wrong with it.
///
/// # Errors
/// When a path leads through a value that is no list and no object, or to an element that a list does not have.
pub fn apply(file: &str, text: Vec<u8>, settings: &[Setting]) -> Result<Vec<u8>, SettingError> {
    if settings.is_empty() {
        return Ok(text);
    }
    let Ok(read) = std::str::from_utf8(&text) else { return Ok(text) };
    let read = read.strip_prefix('\u{feff}').unwrap_or(read);
    let changed = settings.iter().try_fold(read.to_string(), |text, one| one.set(file, &text))?;
    Ok(changed.into_bytes())
}

/// Returns the name of a file in messages: with a remark if settings changed its text.
#[must_use]
pub fn name(file: String, settings: &[Setting]) -> String {
    if settings.is_empty() { file } else { format!("{file} (with -D)") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    const TEXT: &str = "{\"camera\": {\"fov_deg\": 40},\n \"objects\": [{\"sphere\": {\"radius\": 1}}, {}],\n \"one\": 1}";

    fn set(arguments: &[&str]) -> Result<Value, String> {
        let settings: Vec<Setting> = arguments.iter().map(|one| one.parse().unwrap()).collect();
        let text = apply("a.json", TEXT.into(), &settings).map_err(|error| error.to_string())?;
        Ok(serde_json::from_slice(&text).unwrap())
    }

    #[test]
    fn a_value_replaces_another_and_the_rest_stays() {
        let changed = set(&["camera.fov_deg=35", "objects[0].sphere.radius=[1, 2]"]).unwrap();
        let mut expected: Value = serde_json::from_str(TEXT).unwrap();
        expected["camera"]["fov_deg"] = json!(35);
        expected["objects"][0]["sphere"]["radius"] = json!([1, 2]);
        assert_eq!(changed, expected);
    }

    #[test]
    fn a_setting_without_its_first_key_is_one_of_the_file_below() {
        let setting: Setting = "scene.objects[0].material=my glass".parse().unwrap();
        let below = setting.below("scene").unwrap();
        assert_eq!(below.text(), "objects[0].material=\"my glass\"");
        assert_eq!(below.argument(), setting.argument());
        assert_eq!(setting.below("objects"), None);
    }

    #[test]
    fn missing_keys_are_added() {
        let changed = set(&["objects[1].material.gloss=0.5", "camera.at=x=y", "objects[1].a=null"]);
        let changed = changed.unwrap();
        assert_eq!(changed["objects"][1], json!({"material": {"gloss": 0.5}, "a": null}));
        assert_eq!(changed["camera"], json!({"fov_deg": 40, "at": "x=y"}));
    }

    #[test]
    fn later_settings_see_what_earlier_ones_made() {
        assert_eq!(set(&["a.b=[0]", "a.b[0]=7"]).unwrap()["a"], json!({"b": [7]}));
    }

    #[test]
    fn a_path_that_leads_nowhere_is_an_error() {
        for (argument, message) in [
            (
                "objects[2].a=1",
                "found objects[2], expected a number below 2, the length of the list",
            ),
            (
                "objects.a=1",
                "found a list at objects, expected the number of an element, as in [0]",
            ),
            ("camera[0]=1", "found an object at camera, expected the name of a key"),
            ("one.two=1", "found a single value at one, expected a path that ends here"),
            ("new[0]=1", "found no list new, expected one to change an element of"),
        ] {
            assert_eq!(set(&[argument]), Err(format!("-D {argument}: a.json: {message}")));
        }
    }

    #[test]
    fn arguments_of_another_form_are_refused() {
        for argument in ["", "a", "=1", "a..b=1", "a[x]=1", "a[0=1", "a[]=1", "[0]=1"] {
            assert!(argument.parse::<Setting>().is_err(), "{argument}");
        }
    }

    #[test]
    fn text_that_is_not_json_stays() {
        let settings = ["a=1".parse().unwrap()];
        for text in [&b"{\"a\": "[..], b"\xff", b""] {
            assert_eq!(apply("a", text.into(), &settings).unwrap(), text);
        }
    }
}
