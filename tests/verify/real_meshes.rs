//! Real meshes, whose counts two other exact implementations agree on.

use std::time::Instant;

use bespoke::verify::intersections;

use testing::obj::{assets, read_mesh};

#[test]
fn self_intersections() {
    let Some(assets) = assets() else { return };
    for (file, expected) in [
        ("avatars/Goblin/avatar.obj", 6193),
        ("avatars/FoxGirl/avatar.obj", 1801),
        ("garments/Puffer_dense/garment.obj", 0),
        ("garments/jumpsuit_dense/garment.obj", 0),
    ] {
        let mesh = read_mesh(&assets.join(file));
        let start = Instant::now();
        let found = intersections(&mesh, None, 10).unwrap();
        println!("{file}: {} in {:.1} ms", found.count, 1e3 * start.elapsed().as_secs_f64());
        assert_eq!(found.count, expected, "{file}: {:?}", found.pairs);
    }
}

#[test]
fn garment_against_avatar() {
    let Some(assets) = assets() else { return };
    for garment in ["Puffer_dense", "jumpsuit_dense"] {
        let worn = read_mesh(&assets.join("garments").join(garment).join("garment.obj"));
        let body = read_mesh(&assets.join("garments").join(garment).join("mannequin.obj"));
        let start = Instant::now();
        let found = intersections(&worn, Some(&body), 10).unwrap();
        let sizes = (worn.triangles.len(), body.triangles.len());
        println!("{garment} {sizes:?}: {} in {:.1} ms", found.count, 1e3 * start.elapsed().as_secs_f64());
        assert_eq!(found.count, intersections(&body, Some(&worn), 0).unwrap().count);
    }
}

#[test]
fn body_in_body() {
    let Some(assets) = assets() else { return };
    let body = |name: &str| read_mesh(&assets.join("avatars").join(name).join("avatar.obj"));
    for (first, second, expected) in [("slim_adult", "heavy_adult", 2448), ("child", "slim_adult", 1444)] {
        let (a, b) = (body(first), body(second));
        let start = Instant::now();
        let found = intersections(&a, Some(&b), 10).unwrap();
        let sizes = (a.triangles.len(), b.triangles.len());
        println!("{first} in {second} {sizes:?}: {} in {:.1} ms", found.count, 1e3 * start.elapsed().as_secs_f64());
        assert_eq!(found.count, expected);
    }
}
