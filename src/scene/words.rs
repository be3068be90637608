//! Serde's words for what does not fit, turned into words for someone who writes scenes.

/// The key to blame, what is wrong, and what to do, from a message of serde. `key` is the key at
/// the place of the error and `found` the text there.
pub(super) fn of_serde(message: &str, key: &str, found: &str) -> (String, String, String) {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let section = |key: &str| match key.rsplit_once('.') {
        Some((section, _)) => format!("section `{section}`"),
        None => "a scene".to_owned(),
    };
    if let (true, Some((name, known))) =
        (message.starts_with("unknown field"), quoted.split_first())
    {
        let problem = format!("{} has no key `{name}`", section(key));
        return (key.to_owned(), problem, suggestion(name, known));
    }
    if let (true, Some((name, known))) =
        (message.starts_with("unknown variant"), quoted.split_first())
    {
        return (key.to_owned(), format!("`{name}` is not known here"), suggestion(name, known));
    }
    if let (true, Some(name)) = (message.starts_with("missing field"), quoted.first()) {
        let full = if key.is_empty() { (*name).to_owned() } else { format!("{key}.{name}") };
        let remedy = match super::schema::describe(&full) {
            Some(description) => format!("add `{name}`: {description}"),
            None => format!("add `{name}`"),
        };
        return (full, "it is missing".to_owned(), remedy);
    }
    if let Some(name) = found.strip_prefix("[[").and_then(|rest| rest.strip_suffix("]]")) {
        let problem = "there can be only one such section".to_owned();
        return (name.to_owned(), problem, format!("write [{name}]"));
    }
    if let Some((_, expected)) = message.rsplit_once("expected ") {
        let expected = expected
            .replace("f64", "a number")
            .replace("i64", "a whole number")
            .replace("an array of length 3", "three values [x, y, z]")
            .replace("struct ", "a section such as ");
        let shown = if found.contains('\n') { "this" } else { found };
        let remedy = match super::schema::describe(key) {
            Some(description) => format!("`{key}` is: {description}"),
            None => format!("give {expected}"),
        };
        return (key.to_owned(), format!("{shown} is not {expected}"), remedy);
    }
    (key.to_owned(), message.to_owned(), "see `psmrt schema` for what a scene may hold".to_owned())
}

/// "did you mean" if a known name is close, and all that are known.
fn suggestion(name: &str, known: &[&str]) -> String {
    let lower = name.to_lowercase();
    let closest = known
        .iter()
        .map(|candidate| (strsim::damerau_levenshtein(&lower, candidate), candidate))
        .min_by_key(|(distance, _)| *distance);
    let all = known.join(", ");
    match closest {
        Some((distance, candidate)) if distance <= (name.len() / 3).max(1) => {
            format!("did you mean `{candidate}`? (known: {all})")
        }
        _ => format!("known are: {all}"),
    }
}
