//! Messages of two rigs name the joints of their common skeleton.

use bespoke::rig::words::with_names;

fn names() -> Vec<String> {
    ["pelvis", "waist", "neck"].map(String::from).to_vec()
}

#[test]
fn numbers_of_joints_become_names() {
    for (message, want) in [
        ("at the bone between joints 0 and 1: cut", "at the bone between pelvis and waist: cut"),
        ("bone 3 (joints 1-2)", "bone 3 (waist to neck)"),
        ("joint 2 lies outside", "neck lies outside"),
        (
            "they bind it to joint 1, and the bone between joints 0 and 2 is nearest",
            "they bind it to waist, and the bone between pelvis and neck is nearest",
        ),
    ] {
        assert_eq!(with_names(message, &names()), want);
    }
}

#[test]
fn what_names_no_known_joint_stays() {
    for message in
        ["", "joint", "joints 0", "joint 7 is far", "joints 0 and 9", "the joints of both", "disjoint 1", "joint x"]
    {
        assert_eq!(with_names(message, &names()), message);
    }
}
