//! The core's refusals, told to JavaScript.

use muslin::Error;
use wasm_bindgen::JsError;

/// The result of a call that may be refused.
pub(crate) type Result<T, E = JsError> = core::result::Result<T, E>;

/// The core's refusal as an `Error`, with names in camelCase.
pub(crate) fn refusal(error: Error) -> JsError {
    JsError::new(&in_camel_case(&error.to_string()))
}

/// Turns `snake_case` into `snakeCase`, only where it is quoted.
fn in_camel_case(message: &str) -> String {
    let mut told = String::with_capacity(message.len());
    let (mut is_quoted, mut starts_word) = (false, false);
    for letter in message.chars() {
        is_quoted ^= letter == '`';
        if is_quoted && letter == '_' {
            starts_word = true;
            continue;
        }
        told.push(if starts_word { letter.to_ascii_uppercase() } else { letter });
        starts_word = false;
    }
    told
}
