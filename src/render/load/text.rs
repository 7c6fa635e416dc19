//! Text of unknown encoding.

/// UTF-8 if it is, otherwise ISO 8859-1 (what Java's property files and old exporters write).
pub(in crate::render) fn to_text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap_or_else(|e| e.into_bytes().into_iter().map(char::from).collect())
}
