//! Conversion of [`muslin::Error`] to a JavaScript `Error`.
//!
//! Reads the message of the core's error; writes the same sentence with every name between
//! backticks in camelCase, as JavaScript spells it: `max_stretch` becomes `maxStretch`.

use muslin::Error;
use wasm_bindgen::JsError;

/// Result of a call that the core may refuse.
pub(crate) type Result<T, E = JsError> = core::result::Result<T, E>;

/// Converts an error of the core to a JavaScript `Error` with the names in camelCase.
pub(crate) fn to_js_error(error: Error) -> JsError {
    #[cfg(not(feature = "full"))]
    if let Error::MissingFeature { what, .. } = error {
        return missing(what);
    }
    JsError::new(&quoted_names_to_camel_case(&error.message()))
}

/// Returns the error of a call that only the full module has.
#[cfg(not(feature = "full"))]
pub(crate) fn missing(what: &str) -> JsError {
    JsError::new(&[what, " is not in muslin/light; import it from \"muslin\""].concat())
}

/// Turns `snake_case` into `snakeCase`, only between backticks.
fn quoted_names_to_camel_case(message: &str) -> String {
    let mut converted = String::with_capacity(message.len());
    let (mut is_quoted, mut starts_word) = (false, false);
    for letter in message.chars() {
        is_quoted ^= letter == '`';
        if is_quoted && letter == '_' {
            starts_word = true;
            continue;
        }
        converted.push(if starts_word { letter.to_ascii_uppercase() } else { letter });
        starts_word = false;
    }
    converted
}
