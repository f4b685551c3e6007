//! What parts of files are taken for, by the names that real tools write.

use bespoke_cli::parts::garments::{Piece, group};
use bespoke_cli::parts::pattern::Patterns;
use bespoke_cli::parts::{Kind, Named, Role, sort};
use glam::DVec3;

use Kind::{Body, Garment, Hair, Prop};

/// Node, material, and what it is.
type Line = (&'static str, &'static str, Kind);

fn kinds(lines: &[Line], role: Role) -> Vec<Kind> {
    let named: Vec<Named> =
        lines.iter().map(|&(node, material, _)| Named { node, material, ..Named::default() }).collect();
    sort(&named, role).into_iter().map(|sorted| sorted.kind).collect()
}

fn holds(lines: &[Line]) {
    let expected: Vec<Kind> = lines.iter().map(|line| line.2).collect();
    assert_eq!(kinds(lines, Role::Outfit), expected, "{lines:?}");
}

/// Names as Ready Player Me, VRoid Studio, Mixamo, Character Creator and Quaternius write them.
#[test]
fn names_of_tools() {
    holds(&[
        ("Wolf3D_Body", "Wolf3D_Body", Body),
        ("Wolf3D_Outfit_Top", "Wolf3D_Outfit_Top", Garment),
        ("Wolf3D_Outfit_Footwear", "Wolf3D_Outfit_Footwear", Garment),
        ("Wolf3D_Head", "Wolf3D_Skin", Body),
        ("Wolf3D_Teeth", "Wolf3D_Teeth", Body),
        ("Wolf3D_Hair", "Wolf3D_Hair", Hair),
        ("Wolf3D_Glasses", "Wolf3D_Glasses", Prop),
        ("EyeLeft", "Wolf3D_Eye", Body),
    ]);
    holds(&[
        ("Face", "N00_000_00_FaceMouth_00_FACE (Instance)", Body),
        ("Face", "N00_000_00_EyeIris_00_EYE (Instance)", Body),
        ("Body", "N00_000_00_Body_00_SKIN (Instance)", Body),
        ("Body", "N00_002_03_Tops_01_CLOTH (Instance)", Garment),
        ("Body", "N00_001_02_Bottoms_01_CLOTH (Instance)", Garment),
        ("Body", "N00_008_01_Shoes_01_CLOTH (Instance)", Garment),
        ("Hair001", "N00_000_Hair_00_HAIR_01 (Instance)", Hair),
        ("Body", "N00_000_00_HairBack_00_HAIR (Instance)", Hair),
    ]);
    holds(&[
        ("Ch31_Body", "Ch31_body", Body),
        ("Ch31_Eyelashes", "Ch31_hair", Hair),
        ("Ch31_Pants", "Ch31_body", Garment),
        ("Ch31_Sweater", "Ch31_body", Garment),
        ("Ch31_Collar", "Ch31_body", Garment),
    ]);
    holds(&[
        ("CC_Base_Body", "Std_Skin_Head", Body),
        ("CC_Base_Body", "Std_Nails", Body),
        ("CC_Base_Eye", "Std_Cornea_L", Body),
        ("Rolled_sleeves_shirt", "Rolled_sleeves_shirt", Garment),
        ("Pleated_Skirt", "Pleated_Skirt", Garment),
        ("Bob_Style", "Hair_Transparency", Hair),
    ]);
    // Clothes have the names of colours there, and the character's own name is that of a garment.
    holds(&[
        ("Suit_Body", "White", Garment),
        ("Suit_Body", "Skin", Body),
        ("Suit_Legs", "Black", Garment),
        ("Suit_Head", "Hair", Hair),
        ("Suit_Head", "Eyebrows", Body),
        ("Suit_Head", "Brown", Body),
    ]);
}

/// Without the name of skin, a region of the body is body.
#[test]
fn a_region_is_body_where_no_skin_is_named() {
    let lines = [
        ("Barbarian_Body", "texture", Body),
        ("Barbarian_ArmLeft", "texture", Body),
        ("Barbarian_Hat", "texture", Garment),
        ("Barbarian_Cape", "texture", Garment),
        ("1H_Axe", "texture", Prop),
    ];
    holds(&lines);
}

/// What no name explains follows from what the file is for, and from the rest of it.
#[test]
fn names_that_say_nothing() {
    let alone = [("Cylinder.001", "Material", Garment)];
    assert_eq!(kinds(&alone, Role::Outfit), [Garment]);
    assert_eq!(kinds(&alone, Role::Avatar), [Body]);
    let with_body = [("Body", "", Body), ("Cylinder.001", "Material", Garment)];
    assert_eq!(kinds(&with_body, Role::Outfit), [Body, Garment]);
    let with_garment = [("Shirt", "", Garment), ("Cylinder.001", "Material", Body)];
    assert_eq!(kinds(&with_garment, Role::Outfit), [Garment, Body]);
}

/// What hangs on a slot for props is one, whatever its name.
#[test]
fn slots_hold_props() {
    let part = |hangs_on| Named { node: "Hat_in_hand", hangs_on, ..Named::default() };
    let kinds: Vec<Kind> =
        sort(&[part(Some("handslot.r")), part(Some("Head"))], Role::Avatar).iter().map(|s| s.kind).collect();
    assert_eq!(kinds, [Prop, Garment]);
}

/// What this program has put on is a garment, whatever its names say, and then the rest of the file is its wearer.
#[test]
fn what_was_put_on_is_a_garment() {
    let part = |node, is_put_on| Named { node, is_put_on, ..Named::default() };
    let parts = [part("Cylinder.001", false), part("Skin_Suit_Head", true), part("Sphere", false)];
    let kinds: Vec<Kind> = sort(&parts, Role::Outfit).iter().map(|s| s.kind).collect();
    assert_eq!(kinds, [Body, Garment, Body]);
}

/// Patterns choose by node and material, and leave out.
#[test]
fn patterns() {
    let choose = |text: &str, node: &str, material: &str| Patterns::parse(text).unwrap().choose(node, material);
    assert!(choose("Suit_Body", "Suit_Body", "White"));
    assert!(!choose("Suit_Body", "Suit_Body2", "White"));
    assert!(choose("Suit_*:White,Hat", "Suit_Body", "White"));
    assert!(!choose("Suit_*:White,Hat", "Suit_Body", "Black"));
    assert!(choose("*_B*y:*", "Suit_Body", ""));
    assert!(!choose("Suit_*,!*:Skin", "Suit_Body", "Skin"));
    assert!(choose("!Hat", "Suit_Body", ""));
    assert!(choose(":Skin", "Suit_Body", "Skin"));
    assert!(!choose("aba*ba", "aba", ""));
    assert!(choose("aba*ba", "ababa", ""));
    assert_eq!(Patterns::parse("Hat,:Cape").unwrap().idle(&[("Hat", "")]), ["*:Cape"]);
    for empty in ["", "Hat,,Cape", "!"] {
        assert!(Patterns::parse(empty).unwrap_err().contains("empty pattern"));
    }
}

/// A brute-force twin of the pattern's `*`: all ways to share out the text.
#[test]
fn a_star_is_any_text() {
    fn twin(pattern: &[u8], name: &[u8]) -> bool {
        match pattern.split_first() {
            None => name.is_empty(),
            Some((b'*', rest)) => (0..=name.len()).any(|skip| twin(rest, &name[skip..])),
            Some((c, rest)) => name.first() == Some(c) && twin(rest, &name[1..]),
        }
    }
    let all = |alphabet: &[u8], longest: usize| -> Vec<String> {
        let mut all = vec![String::new()];
        let mut last = all.clone();
        for _ in 0..longest {
            last = last.iter().flat_map(|s| alphabet.iter().map(move |&c| format!("{s}{}", c as char))).collect();
            all.extend(last.clone());
        }
        all
    };
    for pattern in all(b"ab*", 5).iter().filter(|p| !p.is_empty()) {
        let patterns = Patterns::parse(pattern).unwrap();
        for name in all(b"ab", 5) {
            let expected = twin(pattern.as_bytes(), name.as_bytes());
            assert_eq!(patterns.choose(&name, "anything"), expected, "{pattern} {name}");
        }
    }
}

/// A button lies within the jacket, a lining shares its seam, the shoes below lie apart, and another node is another garment.
#[test]
fn garments() {
    let corners = |low: [f64; 3], high: [f64; 3]| vec![DVec3::from_array(low), DVec3::from_array(high)];
    let jacket = corners([-1.0, 1.0, -0.3], [1.0, 2.0, 0.3]);
    let button = corners([0.0, 1.2, 0.29], [0.01, 1.21, 0.31]);
    let shoes = corners([-0.5, 0.0, -0.3], [0.5, 0.2, 0.3]);
    let seam = corners([1.0, 2.0, 0.3], [3.0, 4.0, 5.0]);
    let pieces = [
        Piece { node: 7, positions: &shoes },
        Piece { node: 7, positions: &button },
        Piece { node: 7, positions: &seam },
        Piece { node: 7, positions: &jacket },
        Piece { node: 8, positions: &jacket },
        Piece { node: 7, positions: &[] },
    ];
    assert_eq!(group(&pieces), [vec![0], vec![1, 2, 3], vec![4], vec![5]]);
}
