//! Patterns that choose parts by name: `node:material` with `*` for any text and `!` before what is left out.

/// Some patterns; a part is chosen by one that matches it, unless one with `!` does.
#[derive(Clone, Debug, Default)]
pub struct Patterns {
    wanted: Vec<[String; 2]>,
    unwanted: Vec<[String; 2]>,
}

impl Patterns {
    /// Reads patterns between commas: `Suit_Body:*,!*:Skin`. A material that is not named is any; a node that is not is
    /// any, too (`:Skin`).
    ///
    /// # Errors
    /// A sentence where one is empty.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut patterns = Self::default();
        for piece in text.split(',').map(str::trim) {
            let (list, piece) = match piece.strip_prefix('!') {
                Some(rest) => (&mut patterns.unwanted, rest),
                None => (&mut patterns.wanted, piece),
            };
            if piece.is_empty() {
                return Err(format!(
                    "'{text}' has an empty pattern: write names of nodes between commas, such as \
                     'Body_Top,Body_Legs', with ':MATERIAL' behind where one material of a node is meant"
                ));
            }
            let (node, material) = piece.split_once(':').unwrap_or((piece, "*"));
            let any_if_empty = |name: &str| if name.is_empty() { "*".to_string() } else { name.to_string() };
            list.push([any_if_empty(node), any_if_empty(material)]);
        }
        Ok(patterns)
    }

    /// Whether a part is chosen.
    pub fn choose(&self, node: &str, material: &str) -> bool {
        let any = |list: &[[String; 2]]| list.iter().any(|[n, m]| matches(n, node) && matches(m, material));
        (self.wanted.is_empty() || any(&self.wanted)) && !any(&self.unwanted)
    }

    /// Whether a part is chosen by a pattern that names its material, or the text of one.
    pub fn choose_by_material(&self, node: &str, material: &str) -> bool {
        let by_material = |[n, m]: &[String; 2]| m != "*" && matches(n, node) && matches(m, material);
        self.choose(node, material) && self.wanted.iter().any(by_material)
    }

    /// The patterns that match none of `parts`, (node, material), as they were written.
    pub fn idle(&self, parts: &[(&str, &str)]) -> Vec<String> {
        let idle =
            |[n, m]: &&[String; 2]| !parts.iter().any(|(node, material)| matches(n, node) && matches(m, material));
        let written = |[n, m]: &[String; 2]| if m == "*" { n.clone() } else { format!("{n}:{m}") };
        self.wanted.iter().chain(&self.unwanted).filter(idle).map(written).collect()
    }
}

/// Whether `name` is `pattern`, in which `*` is any text, also none.
fn matches(pattern: &str, name: &str) -> bool {
    let mut pieces = pattern.split('*');
    let first = pieces.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else { return false };
    let mut last = None;
    for piece in pieces {
        if let Some(middle) = last.replace(piece) {
            let Some(at) = rest.find(middle) else { return false };
            rest = &rest[at + middle.len()..];
        }
    }
    match last {
        Some(end) => rest.ends_with(end),
        None => rest.is_empty(),
    }
}
