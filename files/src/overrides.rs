//! Overrides of a file's values: `path.key=value`.

/// The keys before the last, the last key, and the value of `path.key=value`, the value written as in TOML; an integer is a
/// number like any other.
///
/// # Errors
/// What is wrong with the assignment, in words.
pub(crate) fn parse(assignment: &str) -> Result<(Vec<&str>, &str, toml::Value), String> {
    let (path, value) = assignment.split_once('=').ok_or("no `=`")?;
    let value: toml::Table = toml::from_str(&format!("value = {}", value.trim()))
        .map_err(|error| error.message().to_owned())?;
    let value = value.get("value").cloned().ok_or("no value")?;
    let mut keys: Vec<&str> = path.trim().split('.').collect();
    let last = keys.pop().filter(|key| !key.is_empty()).ok_or("no key")?;
    let value = match value {
        toml::Value::Integer(number) => toml::Value::Float(number as f64),
        other => other,
    };
    Ok((keys, last, value))
}

/// The parser's message with the nearest known key where it met an unknown one.
pub(crate) fn explain(error: &toml::de::Error) -> String {
    let message = error.to_string();
    let message = message.trim_end();
    let quoted: Vec<&str> = error.message().split('`').skip(1).step_by(2).collect();
    match quoted.split_first() {
        Some((unknown, known))
            if error.message().starts_with("unknown field")
                || error.message().starts_with("unknown variant") =>
        {
            format!("{message}{}", nearest(unknown, known.iter().copied()))
        }
        _ => message.to_owned(),
    }
}

/// `; did you mean` the nearest of the `known` words, where one is near.
pub fn nearest<'a>(unknown: &str, known: impl Iterator<Item = &'a str>) -> String {
    known
        .map(|key| (strsim::jaro_winkler(unknown, key), key))
        .filter(|(likeness, _)| *likeness > 0.7)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map_or_else(String::new, |(_, key)| format!("; did you mean `{key}`?"))
}
