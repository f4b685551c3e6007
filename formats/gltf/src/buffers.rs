//! The bytes behind a URI: data within the text, or a file beside it.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::alphabet::{STANDARD, URL_SAFE};
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;

/// Finds what a relative URI stands for, with the reason where it cannot.
pub type Resolver = Box<dyn Fn(&str) -> Result<Vec<u8>, String> + Send + Sync>;

/// A resolver for documents that are whole by themselves: it has no file.
#[must_use]
pub fn nothing_outside() -> Resolver {
    Box::new(|_| Err("is a file of its own, and this document was given as bytes alone".into()))
}

/// A resolver for the files below `folder`.
#[must_use]
pub fn files_in(folder: &Path) -> Resolver {
    let folder = folder.to_owned();
    Box::new(move |uri| {
        let name = file_name(uri)?;
        let path = folder.join(&name);
        let failed = |reason: std::io::Error| format!("'{}' cannot be read: {reason}", path.display());
        let meta = std::fs::metadata(&path).map_err(failed)?;
        if !meta.is_file() {
            return Err(format!("'{}' is no file", path.display()));
        }
        let mut bytes = Vec::new();
        // Not more than it had when it was opened.
        File::open(&path).and_then(|file| file.take(meta.len()).read_to_end(&mut bytes)).map_err(failed)?;
        Ok(bytes)
    })
}

/// The relative path that a URI stands for.
///
/// # Errors
/// With the reason where it is an address with a scheme or an absolute path.
pub fn file_name(uri: &str) -> Result<String, String> {
    let name = percent_decode_str(uri).decode_utf8().map_err(|_| "is no path in UTF-8".to_owned())?;
    let scheme = uri.split_once(':').is_some_and(|(scheme, _)| {
        scheme.starts_with(|c: char| c.is_ascii_alphabetic())
            && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))
    });
    if scheme || name.starts_with(['/', '\\']) || name.contains('\0') {
        return Err("is not the path of a file beside the document".into());
    }
    Ok(name.into_owned())
}

/// Whether a URI has its data within.
pub(crate) fn is_data(uri: &str) -> bool {
    uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

/// The media type and the bytes of a data URI.
pub(crate) fn data(uri: &str) -> Result<(String, Vec<u8>), String> {
    let (head, body) = uri[5..].split_once(',').ok_or("is a data URI without a comma")?;
    let mut words = head.split(';');
    let media = words.next().unwrap_or_default().to_owned();
    if !words.any(|word| word.eq_ignore_ascii_case("base64")) {
        return Ok((media, percent_decode_str(body).collect()));
    }
    let escaped: Vec<u8>;
    let body = if body.contains('%') {
        escaped = percent_decode_str(body).collect();
        &escaped[..]
    } else {
        body.as_bytes()
    };
    let lenient = GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true);
    let alphabet = if body.iter().any(|b| b"-_".contains(b)) { URL_SAFE } else { STANDARD };
    let bytes = GeneralPurpose::new(&alphabet, lenient).decode(body);
    Ok((media, bytes.map_err(|reason| format!("is no base64: {reason}"))?))
}

/// A data URI of `bytes`.
pub(crate) fn to_data(media: &str, bytes: &[u8]) -> String {
    format!("data:{media};base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
}
