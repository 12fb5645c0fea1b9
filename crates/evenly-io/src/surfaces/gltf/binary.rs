//! Binary glTF: a head, and chunks, of which the first is the document and the second bytes for it (glTF 2.0, section 4).

const MAGIC: &[u8] = b"glTF";
const HEAD: usize = 12;
const CHUNK_HEAD: usize = 8;

/// The document, and the bytes that a binary file has after it.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    if !bytes.starts_with(MAGIC) {
        return Ok((bytes, None));
    }
    let cut_short = || "this is no binary glTF: it is cut short".to_owned();
    let version = word(bytes, 4).ok_or_else(cut_short)?;
    if version != 2 {
        return Err(format!("this is binary glTF {version}; 2 alone is read"));
    }
    let whole = word(bytes, 8).and_then(|length| bytes.get(HEAD..length)).ok_or_else(cut_short)?;
    let (kind, json, rest) = chunk(whole).ok_or_else(cut_short)?;
    if kind != b"JSON" {
        return Err("this is no binary glTF: it does not begin with a document".into());
    }
    if rest.is_empty() {
        return Ok((json, None));
    }
    let (kind, blob, _) = chunk(rest).ok_or_else(cut_short)?;
    Ok((json, (kind == b"BIN\0").then_some(blob)))
}

/// A chunk's kind and bytes, and what follows it.
fn chunk(bytes: &[u8]) -> Option<(&[u8], &[u8], &[u8])> {
    let length = word(bytes, 0)?;
    let (own, rest) = bytes.get(CHUNK_HEAD..)?.split_at_checked(length)?;
    Some((bytes.get(4..CHUNK_HEAD)?, own, rest))
}

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let four = bytes.get(at..)?.first_chunk()?;
    usize::try_from(u32::from_le_bytes(*four)).ok()
}
