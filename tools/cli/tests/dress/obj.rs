//! Outfits and avatars as OBJ files, with skeleton and skin weights beside them.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::weld::Weld;
use bespoke::verify::intersections;
use bespoke_gltf::Document;
use closet::avatars::{Avatar, avatar};
use closet::skeleton::BONES;
use closet::{Kind, Sample, garments, sample};
use glam::DVec3;
use serde_json::Value;
use testing::obj::read_mesh;
use testing::obj_text::obj;

use super::files::folder;
use super::{AVATAR, OUTFIT, bespoke, ends, judges, mesh};

/// Blender's axes, in which the closet models.
const UPRIGHT: &str = "x,z,y";

/// The vest's materials: an image under a name with options before it, and a colour that the back shows through.
const MATERIALS: &str = "\
newmtl Wool
Kd 0.5 0.25 1
map_Kd -s 1 1 1 wool.png

newmtl Lining
Ns 10
Kd 0.5 0.25 1
d 0.75
";

/// One pixel, as PNG.
const PIXEL: &[u8] = &[
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00,
    0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00, 0x0C, 0x49,
    0x44, 0x41, 0x54, 0x78, 0x9C, 0x63, 0x68, 0x50, 0x50, 0x00, 0x00, 0x01, 0xE4, 0x00, 0xC1, 0xEA, 0x5B, 0x19, 0x17,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82,
];

fn short(points: &[DVec3]) -> Vec<[f32; 3]> {
    points.iter().map(|p| p.as_vec3().to_array()).collect()
}

/// The vest with texture coordinates, groups and two materials, which change at a third and two thirds of its faces.
fn vest() -> String {
    let vest = garments::vest(2.5).mesh;
    let mut text = String::from("# a vest\nmtllib vest.mtl\no Cylinder.001\n");
    for p in short(&vest.positions) {
        writeln!(text, "v {} {} {}", p[0], p[1], p[2]).unwrap();
    }
    for p in &vest.positions {
        writeln!(text, "vt {} {}", p.x as f32, p.z as f32).unwrap();
    }
    let third = vest.triangles.len() / 3;
    for (k, triangle) in vest.triangles.iter().enumerate() {
        if k == 0 {
            text += "g front\nusemtl Wool\ns 1\n";
        } else if k == third {
            text += "usemtl Lining\n";
        } else if k == 2 * third {
            text += "g back\nusemtl Wool\n";
        }
        let [a, b, c] = triangle.map(|v| v + 1);
        writeln!(text, "f {a}/{a} {b}/{b} {c}/{c}").unwrap();
    }
    text
}

fn skeleton(sample: &Sample) -> String {
    obj(&short(&sample.skeleton.joints), &[], &BONES)
}

fn body(sample: &Sample) -> String {
    obj(&short(&sample.mesh.positions), &sample.mesh.triangles, &[])
}

/// A row for each joint.
fn matrix(sample: &Sample) -> String {
    let row = |row: &Vec<f64>| row.iter().map(|w| (*w as f32).to_string()).collect::<Vec<_>>().join(" ") + "\n";
    sample.skin.iter().map(row).collect()
}

/// The vest and its mannequin in one folder, the slim body in another, as `retarget` is given them.
pub fn write_files(folder: &Path) {
    let (mannequin, slim) = (sample(Kind::Mannequin), avatar(Avatar::Slim));
    let write = |name: &str, text: String| {
        fs::create_dir_all(folder.join(name).parent().unwrap()).unwrap();
        fs::write(folder.join(name), text).unwrap();
    };
    write("design/vest.obj", vest());
    write("design/vest.mtl", MATERIALS.into());
    fs::write(folder.join("design/wool.png"), PIXEL).unwrap();
    write("design/mannequin.obj", body(&mannequin));
    write("design/skeleton.obj", skeleton(&mannequin));
    write("slim/avatar.obj", format!("# slim\no Slim\n{}", body(&slim)));
    write("slim/skeleton.obj", skeleton(&slim));
    write("slim/skin.txt", matrix(&slim));
    fs::write(folder.join("outfit.glb"), &*OUTFIT).unwrap();
    fs::write(folder.join("avatar.glb"), &*AVATAR).unwrap();
}

fn lines<'a>(text: &'a str, key: &str) -> Vec<&'a str> {
    text.lines().filter(|line| line.split_whitespace().next() == Some(key)).collect()
}

/// The vertices of each corner of each face, from 1.
fn faces(text: &str) -> Vec<Vec<usize>> {
    let vertex = |word: &str| word.split('/').next().unwrap().parse().unwrap();
    lines(text, "f").iter().map(|line| line.split_whitespace().skip(1).map(vertex).collect()).collect()
}

/// The part of a mesh whose faces are in a range, with all of its vertices.
fn range(mesh: &TriangleMesh, faces: std::ops::Range<usize>) -> TriangleMesh {
    TriangleMesh { positions: mesh.positions.clone(), triangles: mesh.triangles[faces].to_vec() }
}

/// OBJ in and out: the avatar's lines are as they were, and behind them the garment as it stands in its own file.
#[test]
fn obj_to_obj() {
    let folder = folder("obj-to-obj");
    write_files(&folder);
    let source = ["--source", "design/mannequin.obj"];
    let run = bespoke(
        &folder,
        &[
            "dress",
            "design/vest.obj",
            "slim/avatar.obj",
            source[0],
            source[1],
            "-o",
            "out.obj",
            "--json",
            "report.json",
        ],
    );
    ends(&run, 0);
    let said = String::from_utf8_lossy(&run.stderr);
    for found in ["skeleton from design/skeleton.obj", "skin weights from slim/skin.txt"] {
        assert!(said.contains(found), "{found} is not said: {said}");
    }
    let avatar = fs::read_to_string(folder.join("slim/avatar.obj")).unwrap();
    let (vest, text) = (vest(), fs::read_to_string(folder.join("out.obj")).unwrap());
    let own = text.strip_prefix("mtllib vest.mtl\n").expect("the materials come first");
    let worn = own.strip_prefix(&*avatar).expect("the avatar's lines are as they were");
    assert_eq!(lines(worn, "o"), ["o Cylinder.001"]);
    assert_eq!(lines(worn, "vt"), lines(&vest, "vt"));
    // Groups, materials and smoothing hold for the same faces as in the garment's file.
    let states = |text: &str| {
        let mut now = [String::new(), String::new(), String::new()];
        let mut all = Vec::new();
        for line in text.lines() {
            match line.split_whitespace().next() {
                Some("g") => now[0] = line.into(),
                Some("usemtl") => now[1] = line.into(),
                Some("s") => now[2] = line.into(),
                Some("f") => all.push(now.clone()),
                _ => {}
            }
        }
        all
    };
    assert_eq!(states(worn), states(&vest));
    let first = lines(&avatar, "v").len();
    assert_eq!(lines(worn, "v").len(), lines(&vest, "v").len());
    let shifted: Vec<Vec<usize>> = faces(&vest).iter().map(|face| face.iter().map(|v| v + first).collect()).collect();
    assert_eq!(faces(worn), shifted);

    let all = read_mesh(&folder.join("out.obj"));
    let body_faces = faces(&avatar).len();
    let (body, cloth) = (range(&all, 0..body_faces), range(&all, body_faces..all.triangles.len()));
    assert_eq!(intersections(&cloth, Some(&body), 0).unwrap().count, 0);
    assert_eq!(intersections(&cloth, None, 0).unwrap().count, 0);
    let report: Value = serde_json::from_slice(&fs::read(folder.join("report.json")).unwrap()).unwrap();
    assert_eq!(report["garments"][0]["status"], "dressed");
    let map = report["joint_map"].as_array().unwrap();
    assert!(
        map.iter().enumerate().all(|(k, joint)| joint["target"].as_str().unwrap().parse() == Ok(k)),
        "joint {map:?}"
    );

    // Its name says nothing, but the file knows that it was put on.
    ends(&bespoke(&folder, &["check", "out.obj"]), 0);

    // The garment alone has the vertices of its file in their order.
    let run = bespoke(
        &folder,
        &[
            "dress",
            "design/vest.obj",
            "slim/avatar.obj",
            source[0],
            source[1],
            "-o",
            "alone.obj",
            "--keep",
            "outfit",
            "-q",
        ],
    );
    ends(&run, 0);
    assert!(run.stderr.is_empty(), "{}", String::from_utf8_lossy(&run.stderr));
    let alone = fs::read_to_string(folder.join("alone.obj")).unwrap();
    assert_eq!(faces(&alone), faces(&vest));
    assert_eq!(lines(&alone, "v"), lines(worn, "v"));
    // Dressed again, over what it wears: this time it is there to be taken off.
    let avatar = ["--target-skeleton", "slim/skeleton.obj", "--skin-weights", "slim/skin.txt"];
    let again =
        ["dress", "design/vest.obj", "out.obj", source[0], source[1], "-o", "again.obj", "--keep", "body", "-q"];
    let run = bespoke(&folder, &[&again[..], &avatar[..2]].concat());
    ends(&run, 0);
    let again = fs::read_to_string(folder.join("again.obj")).unwrap();
    assert_eq!(lines(&again, "f").len(), lines(&text, "f").len());
}

/// Into GLB, onto the joints of an OBJ skeleton, by which an animation can move it; and from GLB into OBJ.
#[test]
fn obj_and_glb() {
    let folder = folder("obj-and-glb");
    write_files(&folder);
    let spaces = ["--source-space", UPRIGHT, "--target-space", UPRIGHT];
    let dress = |args: &[&str]| ends(&bespoke(&folder, &[&["dress", "-q"], args].concat()), 0);
    let vest = ["design/vest.obj", "--source", "design/mannequin.obj"];
    dress(&[&vest[..], &["slim/avatar.obj", "-o", "all.glb"], &spaces].concat());
    // The avatar has joints with names of its own, another unit and another front.
    dress(&[&vest[..], &["avatar.glb", "-o", "onto.glb"], &spaces[..2]].concat());
    for (file, up) in [("all.glb", 1.0), ("onto.glb", 100.0)] {
        let scene = Document::open(&folder.join(file)).unwrap().scene().unwrap();
        let meshes = &scene.characters[0].meshes;
        assert_eq!(meshes.len(), 2, "{file}");
        // Of two materials, whose seam is one.
        let [body, worn] = [mesh(&meshes[0]), Weld::new(&mesh(&meshes[1])).0.mesh];
        assert_eq!(intersections(&worn, Some(&body), 0).unwrap().count, 0, "{file}");
        assert_eq!(intersections(&worn, None, 0).unwrap().count, 0, "{file}");
        let height = |mesh: &TriangleMesh| {
            let heights = || mesh.positions.iter().map(|p| p.y);
            heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min)
        };
        assert!((1.4 * up..2.2 * up).contains(&height(&body)), "{file}: the body is {} tall", height(&body));
        assert!((0.3 * up..0.8 * up).contains(&height(&worn)), "{file}: the vest is {} tall", height(&worn));
        let joints: std::collections::BTreeSet<u32> =
            meshes[1].geometry.influences.iter().flatten().map(|&(joint, _)| joint).collect();
        assert!(joints.len() > 2, "{file}: it hangs on {joints:?}");
        let document = Document::open(&folder.join(file)).unwrap();
        let materials = document.json()["materials"].as_array().unwrap();
        let material =
            |name: &str| materials.iter().find(|m| m["name"] == name).unwrap_or_else(|| panic!("{file}: {name}"));
        let surface = &material("Lining")["pbrMetallicRoughness"];
        assert_eq!(surface["baseColorFactor"].to_string(), "[0.5,0.25,1.0,0.75]", "{file}");
        assert_eq!(material("Lining")["alphaMode"], "BLEND", "{file}");
        let texture =
            material("Wool")["pbrMetallicRoughness"]["baseColorTexture"]["index"].as_u64().expect("a texture");
        let image = document.json()["textures"][texture as usize]["source"].as_u64().unwrap();
        let view = document.json()["images"][image as usize]["bufferView"].as_u64().unwrap();
        assert_eq!(document.view_bytes(view as usize).unwrap(), PIXEL, "{file}");
        ends(&bespoke(&folder, &["check", file]), 0);
    }
    judges::valid(&[&folder.join("all.glb"), &folder.join("onto.glb")]);

    dress(&["outfit.glb", "slim/avatar.obj", "-o", "from-glb.obj", "--target-space", UPRIGHT]);
    let text = fs::read_to_string(folder.join("from-glb.obj")).unwrap();
    assert_eq!(lines(&text, "usemtl"), ["usemtl Wool"]);
    let avatar = fs::read_to_string(folder.join("slim/avatar.obj")).unwrap();
    let all = read_mesh(&folder.join("from-glb.obj"));
    let body_faces = faces(&avatar).len();
    let (body, cloth) = (range(&all, 0..body_faces), range(&all, body_faces..all.triangles.len()));
    assert_eq!(intersections(&cloth, Some(&body), 0).unwrap().count, 0);
    assert!(cloth.positions[lines(&avatar, "v").len()..].iter().all(|p| (0.5..1.8).contains(&p.z)), "z is up");
}

/// The joints of a sample as a rig, in the tree that bones span from joint 0.
fn rig(prefix: &str, sample: &Sample) -> String {
    let mut above: Vec<i64> = vec![-1; sample.skeleton.joints.len()];
    let mut reached = vec![0];
    let mut at = 0;
    while at < reached.len() {
        for [a, b] in BONES.iter().flat_map(|&[a, b]| [[a as usize, b as usize], [b as usize, a as usize]]) {
            if a == reached[at] && !reached.contains(&b) {
                above[b] = a as i64;
                reached.push(b);
            }
        }
        at += 1;
    }
    let line = |(k, p): (usize, &[f32; 3])| {
        let bind = format!("1 0 0 0 0 1 0 0 0 0 1 0 {} {} {} 1", p[0], p[1], p[2]);
        format!("joint {prefix} {k} {} {bind}\n", above[k])
    };
    short(&sample.skeleton.joints).iter().enumerate().map(line).collect()
}

/// Rigs with names in place of skeletons, and weights in lines.
#[test]
fn rigs_as_text() {
    let folder = folder("obj-rigs");
    write_files(&folder);
    let slim = avatar(Avatar::Slim);
    fs::write(folder.join("slim.rig"), rig("of the slim", &slim)).unwrap();
    fs::write(folder.join("mannequin.rig"), rig("of the mannequin", &sample(Kind::Mannequin))).unwrap();
    let row = |v: usize| {
        let own = slim.skin.iter().enumerate().filter(|(_, row)| row[v] > 0.0);
        own.map(|(joint, row)| format!("{joint} {}", row[v] as f32)).collect::<Vec<_>>().join(" ") + "\n"
    };
    fs::write(folder.join("slim.skin"), (0..slim.mesh.positions.len()).map(row).collect::<String>()).unwrap();
    // Which of these odd names correspond is said by hand.
    let map: String =
        (0..slim.skeleton.joints.len()).map(|k| format!("of the mannequin {k}\tof the slim {k}\n")).collect();
    fs::write(folder.join("map.txt"), map).unwrap();
    let run = bespoke(
        &folder,
        &[
            "dress",
            "design/vest.obj",
            "slim/avatar.obj",
            "--source=design/mannequin.obj",
            "--source-rig=mannequin.rig",
            "--target-rig=slim.rig",
            "--target-skin=slim.skin",
            "--map=map.txt",
            "-o=out.obj",
        ],
    );
    ends(&run, 0);
    ends(&bespoke(&folder, &["check", "out.obj"]), 0);

    // Weights of the outfit and of its body, on a skeleton without names.
    let mannequin = sample(Kind::Mannequin);
    fs::write(folder.join("design/mannequin.skin.txt"), matrix(&mannequin)).unwrap();
    let vest = garments::vest(2.5).mesh;
    let nearest = |p: &DVec3| {
        let distance = |v: &usize| mannequin.mesh.positions[*v].distance_squared(*p);
        (0..mannequin.mesh.positions.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
    };
    let line = |p: &DVec3| {
        let v = nearest(p);
        let own = mannequin.skin.iter().enumerate().filter(|(_, row)| row[v] > 0.0);
        own.map(|(joint, row)| format!("{joint} {}", row[v] as f32)).collect::<Vec<_>>().join(" ") + "\n"
    };
    fs::write(folder.join("vest.skin"), vest.positions.iter().map(line).collect::<String>()).unwrap();
    let dress = ["dress", "design/vest.obj", "slim/avatar.obj", "--source=design/mannequin.obj", "-o=hung.obj"];
    let run = bespoke(&folder, &[&dress[..], &["--garment-skin=vest.skin"]].concat());
    ends(&run, 0);
    ends(&bespoke(&folder, &["check", "hung.obj"]), 0);
}

/// What does not belong together is said, and nothing is written.
#[test]
fn obj_refusals() {
    let folder = folder("obj-refusals");
    write_files(&folder);
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    fs::create_dir_all(folder.join("bare")).unwrap();
    fs::copy(folder.join("slim/avatar.obj"), folder.join("bare/avatar.obj")).unwrap();
    fs::copy(folder.join("design/vest.obj"), folder.join("bare/vest.obj")).unwrap();
    write("nan.obj", "v 0 0 nan\n");
    write("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    write("two.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n");
    write("empty.obj", "v 0 0 0\n");
    write("loose.obj", "v 0 0 0\nv 0 0 1\nv 0 0 2\nl 1 2\n");
    write("rig.txt", "joint root -1 1 0 0\n");
    write("skin.short", "1 0\n0 1\n");
    let before = fs::read_dir(&folder).unwrap().count();
    let (vest, slim) = ("design/vest.obj", "slim/avatar.obj");
    for (args, exit, says) in [
        (&["nan.obj", slim][..], 1, "nan.obj: line 1: 'nan' is not a coordinate"),
        (&["far.obj", slim], 1, "far.obj: line 4: there is no vertex 4; the file has 3"),
        (&["two.obj", slim], 1, "two.obj: line 3: a face has 2 corners"),
        (&["empty.obj", slim], 1, "empty.obj: there are no faces in it"),
        (&["nothing.obj", slim], 1, "nothing.obj: it cannot be read"),
        (&["bare/vest.obj", slim], 1, "bare/vest.obj: there is no skeleton beside it"),
        (&[vest, "bare/avatar.obj"], 1, "bare/avatar.obj: there is no skeleton beside it"),
        (&[vest, slim, "--target-skeleton", "loose.obj"], 1, "joint 2 is not connected"),
        (&[vest, slim, "--target-skeleton", "rig.txt"], 1, "rig.txt: line 1: is not: joint NAME PARENT"),
        (&[vest, slim, "--target-skin", "skin.short"], 1, "skin.short: has 2 lines of 2 words; needed is"),
        (&[vest, slim, "--source-space", "x,y"], 2, "'x,y' are no axes"),
        (&[vest, slim, "--source-space", "x,x,y"], 2, "perpendicular"),
        (&[vest, slim, "--source-skin", "skin.short"], 2, "--source-skin is for the character that --source names"),
        (&["outfit.glb", slim, "--source-skeleton", "loose.obj"], 2, "beside OBJ files alone"),
        (&[vest, "avatar.glb", "--target-skeleton", "loose.obj"], 2, "beside OBJ files alone"),
    ] {
        let run = bespoke(&folder, &[&["dress", "-o", "out.obj"], args].concat());
        // A GLB avatar gives no OBJ file: the name is looked at first.
        let says = if args[1] == "avatar.glb" { "an OBJ file is written where the avatar is one" } else { says };
        ends(&run, exit);
        let said = String::from_utf8_lossy(&run.stderr);
        assert!(said.contains(says), "{args:?}: {said}");
        assert!(!said.contains("panicked"), "{args:?}: {said}");
    }
    // Materials that are not there are no reason to refuse.
    fs::remove_file(folder.join("design/vest.mtl")).unwrap();
    let run = bespoke(&folder, &["inspect", vest]);
    ends(&run, 0);
    let bare = ["dress", vest, "bare/avatar.obj", "--target-skeleton", "slim/skeleton.obj", "-o", "out.glb"];
    let run = bespoke(&folder, &bare);
    ends(&run, 1);
    assert!(String::from_utf8_lossy(&run.stderr).contains("it has no skin weights, which a glTF file needs"));
    assert_eq!(fs::read_dir(&folder).unwrap().count(), before, "something was written");
}
