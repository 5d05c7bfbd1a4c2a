//! Files of one kind: an earlier deck or mesh, and the one that replaces it.

/// True of a file `old` in whose place `new` may be written: it begins as that does, and a deck is one for
/// the same program.
///
/// ```
/// let [deck, other] = ["*HEADING\nball, written by asperity 0.1.0", "*HEADING\nmine"].map(str::as_bytes);
/// assert!(asperity_decks::is_alike(deck, b"*HEADING\nball, written by asperity 0.2.0"));
/// assert!(!asperity_decks::is_alike(other, deck));
/// ```
pub fn is_alike(old: &[u8], new: &[u8]) -> bool {
    let [old, new] = [old, new].map(String::from_utf8_lossy);
    // decks for Abaqus alone have rigid bodies
    let same = |word: &str| old.contains(word) == new.contains(word);
    old.lines().next() == new.lines().next() && same("written by asperity") && same("*RIGID BODY")
}
