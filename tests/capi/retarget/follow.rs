//! What goes along with the garment, as files: normals, followers and morphs.

use testing::caller::Sample;
use testing::obj_text::obj;

use super::{Folder, numbers};

fn scaled(points: &[[f32; 3]], wide: f32) -> Vec<[f32; 3]> {
    points.iter().map(|p| [wide * p[0], p[1], wide * p[2]]).collect()
}

fn points(text: &str) -> Vec<[f32; 3]> {
    numbers(text, "v ").iter().map(|p| [p[0], p[1], p[2]]).collect()
}

/// The mean distance from the y axis.
fn radius(points: &[[f32; 3]]) -> f32 {
    points.iter().map(|p| p[0].hypot(p[2])).sum::<f32>() / points.len() as f32
}

#[test]
fn followers_and_morphs_are_written_beside() {
    let (folder, sample) = (Folder::new("follow"), Sample::new());
    let [garment, avatar] = [&sample.garment, &sample.avatar];
    folder.write("wide.obj", &obj(&scaled(&garment.0, 1.2), &garment.1, &[]));
    folder.write("heavy.obj", &obj(&scaled(&avatar.0, 1.3), &avatar.1, &[]));
    folder.write("coarse.obj", &obj(&garment.0, &garment.1, &[]));
    let arguments = ["--follower", "coarse.obj", "--garment-morph", "wide.obj", "--target-morph", "heavy.obj"];
    folder.accepts(&arguments);
    let result = points(&folder.read("out.obj"));
    let followed = points(&folder.read("out.follower-0.obj"));
    for (p, q) in result.iter().zip(&followed) {
        assert!((0..3).all(|k| (p[k] - q[k]).abs() < 1e-5));
    }
    let wide = points(&folder.read("out.garment-morph-0.obj"));
    let heavy = points(&folder.read("out.target-morph-0.obj"));
    assert!((radius(&wide) / radius(&result) - 1.2).abs() < 0.1);
    assert!(radius(&heavy) > 1.1 * radius(&result));
}

#[test]
fn a_morph_of_another_mesh_is_refused() {
    let (folder, sample) = (Folder::new("follow-other"), Sample::new());
    folder.write("other.obj", &obj(&sample.avatar.0[1..], &[[0, 1, 2]], &[]));
    folder.refuses(&["--target-morph", "other.obj"], 1, &["other.obj: has", "a morph is the same mesh"]);
}

/// A normal that is not the surface's stays so, turned; without the option it is computed.
#[test]
fn normals_of_the_file_are_turned() {
    let (folder, sample) = (Folder::new("follow-normals"), Sample::new());
    let mut text = String::new();
    for p in &sample.garment.0 {
        text += &format!("v {} {} {}\n", p[0], p[1], p[2]);
    }
    text += "vn 0 5 0\n";
    for t in &sample.garment.1 {
        let [a, b, c] = t.map(|v| v + 1);
        text += &format!("f {a}//1 {b}//1 {c}//1\n");
    }
    folder.write("g.obj", &text);
    let up = |text: &str| {
        let normals = text.lines().filter_map(|line| line.strip_prefix("vn "));
        let second = normals.map(|line| line.split(' ').nth(1).unwrap().parse::<f32>().unwrap());
        second.fold(f32::INFINITY, f32::min)
    };
    folder.accepts(&["--garment-normals"]);
    assert!(up(&folder.read("out.obj")) > 0.8);
    folder.accepts(&[]);
    assert!(up(&folder.read("out.obj")) < 0.5);
}
