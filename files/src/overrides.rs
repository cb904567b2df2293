//! Overrides of values in a file: `path.key=value`.

/// A parsed override `path.key=value`.
pub(crate) struct Override<'a> {
    /// Keys of the tables, outermost first.
    pub path: Vec<&'a str>,
    /// Key in the innermost table.
    pub key: &'a str,
    /// Value; integers are converted to floating point.
    pub value: toml::Value,
}

/// Parses an override `path.key=value` with a TOML value.
///
/// # Errors
/// Returns an error message that describes the problem.
pub(crate) fn parse(assignment: &str) -> Result<Override<'_>, String> {
    let (path, value) = assignment.split_once('=').ok_or("no `=`")?;
    let value: toml::Table = toml::from_str(&format!("value = {}", value.trim()))
        .map_err(|error| error.message().to_owned())?;
    let value = value.get("value").cloned().ok_or("no value")?;
    let mut path: Vec<&str> = path.trim().split('.').collect();
    let key = path.pop().filter(|key| !key.is_empty()).ok_or("no key")?;
    let value = match value {
        toml::Value::Integer(number) => toml::Value::Float(number as f64),
        other => other,
    };
    Ok(Override { path, key, value })
}

/// Returns the parser's message; for an unknown key it adds the most similar known key.
pub(crate) fn explain(error: &toml::de::Error) -> String {
    let message = error.to_string();
    let message = message.trim_end();
    let quoted: Vec<&str> = error.message().split('`').skip(1).step_by(2).collect();
    match quoted.split_first() {
        Some((unknown, known))
            if error.message().starts_with("unknown field")
                || error.message().starts_with("unknown variant") =>
        {
            format!("{message}{}", did_you_mean(unknown, known.iter().copied()))
        }
        _ => message.to_owned(),
    }
}

/// Returns `` ; did you mean `word`? `` with the most similar of the `known` words, or an empty text if none is
/// similar.
pub fn did_you_mean<'a>(unknown: &str, known: impl Iterator<Item = &'a str>) -> String {
    known
        .map(|key| (strsim::jaro_winkler(unknown, key), key))
        .filter(|(similarity, _)| *similarity > 0.7)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map_or_else(String::new, |(_, key)| format!("; did you mean `{key}`?"))
}
