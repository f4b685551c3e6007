//! What the words in the names of nodes and materials say about a part of a character's file.

use super::Kind;

/// What is worn.
const WORN: &[&str] = &[
    "anorak",
    "apron",
    "armor",
    "armour",
    "belt",
    "beanie",
    "bikini",
    "blazer",
    "blouse",
    "bodysuit",
    "boot",
    "bra",
    "cape",
    "cardigan",
    "cloak",
    "cloth",
    "clothes",
    "clothing",
    "coat",
    "corset",
    "costume",
    "crown",
    "dress",
    "dungaree",
    "fedora",
    "footwear",
    "garment",
    "glove",
    "gown",
    "hat",
    "headband",
    "headwear",
    "helmet",
    "hood",
    "hoodie",
    "jacket",
    "jean",
    "jersey",
    "jumpsuit",
    "kilt",
    "kimono",
    "legging",
    "loafer",
    "nightgown",
    "onepiece",
    "outfit",
    "overall",
    "pajama",
    "pant",
    "pantie",
    "panty",
    "parka",
    "petticoat",
    "poncho",
    "puffer",
    "pullover",
    "pyjama",
    "robe",
    "sandal",
    "scarf",
    "shawl",
    "shirt",
    "shoe",
    "skirt",
    "sleeve",
    "slipper",
    "sneaker",
    "sock",
    "stocking",
    "suit",
    "sweater",
    "sweatshirt",
    "swimsuit",
    "toga",
    "trouser",
    "tshirt",
    "tunic",
    "tux",
    "tuxedo",
    "underpant",
    "underwear",
    "uniform",
    "vest",
    "waistcoat",
];

/// What is worn, unless another word says where it is: there is a top of the hair, too.
const PERHAPS_WORN: &[&str] =
    &["bottom", "cap", "collar", "cuff", "heel", "short", "tank", "tie", "tight", "top", "trunk"];

/// What is held or carried.
const CARRIED: &[&str] = &[
    "arrow",
    "axe",
    "backpack",
    "bag",
    "bow",
    "briefcase",
    "crossbow",
    "dagger",
    "earring",
    "glasses",
    "gun",
    "hammer",
    "handbag",
    "knife",
    "lantern",
    "mace",
    "mug",
    "pistol",
    "pouch",
    "prop",
    "purse",
    "quiver",
    "rifle",
    "rucksack",
    "sabre",
    "scythe",
    "shield",
    "spear",
    "staff",
    "sword",
    "throwable",
    "torch",
    "wand",
    "watch",
    "weapon",
];

/// What grows on a head.
const HAIR: &[&str] =
    &["bang", "beard", "fringe", "fur", "hair", "hairs", "haircap", "mane", "moustache", "mustache", "ponytail", "wig"];

/// What is bare body by itself: where a file says one of these, it tells its skin from its clothes.
const SKIN: &[&str] = &["flesh", "skin"];

/// Of the head, which is seen whatever is worn.
const HEAD: &[&str] = &[
    "brow", "cornea", "ear", "eye", "eyeball", "eyebrow", "eyelash", "eyelid", "eyeline", "face", "gum", "head",
    "horn", "iris", "jaw", "lash", "lip", "mouth", "nose", "pupil", "sclera", "teeth", "tongue", "tooth",
];

/// Regions of a body: its own, or what covers it.
const REGION: &[&str] = &[
    "abdomen", "anatomy", "arm", "base", "body", "chest", "feet", "finger", "foot", "forearm", "hand", "hip", "leg",
    "limb", "nail", "neck", "pelvis", "tail", "thigh", "toe", "torso", "wing",
];

/// A name in its words, in small letters: `Wolf3D_OutfitTop.001` is wolf, d, outfit, top.
pub fn words(name: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut last_small = false;
    for c in name.chars() {
        if !c.is_alphabetic() || (c.is_uppercase() && last_small) {
            words.extend((!word.is_empty()).then(|| std::mem::take(&mut word)));
        }
        if c.is_alphabetic() {
            word.extend(c.to_lowercase());
        }
        last_small = c.is_lowercase();
    }
    words.extend((!word.is_empty()).then_some(word));
    words
}

/// What one name says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Said {
    /// Something that is known by itself.
    Known(Kind),
    /// The body's own surface, by the word skin.
    Skin,
    /// A region of the body: of its surface, or of what covers it.
    Region,
    /// Nothing.
    Nothing,
}

/// What `words` say, and the word that says it. What is worn comes before what wears it: a headband is no head.
pub fn said(words: &[String]) -> (Said, &str) {
    let tables = [
        (WORN, Said::Known(Kind::Garment)),
        (CARRIED, Said::Known(Kind::Prop)),
        (HAIR, Said::Known(Kind::Hair)),
        (HEAD, Said::Known(Kind::Body)),
        (SKIN, Said::Skin),
        (PERHAPS_WORN, Said::Known(Kind::Garment)),
        (REGION, Said::Region),
    ];
    for (table, says) in tables {
        let is_listed = |word: &&String| {
            let listed = |w: &str| table.contains(&w);
            listed(word) || word.strip_suffix('s').is_some_and(listed) || word.strip_suffix("es").is_some_and(listed)
        };
        if let Some(word) = words.iter().find(is_listed) {
            return (says, word);
        }
    }
    (Said::Nothing, "")
}
