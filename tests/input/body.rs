//! An avatar with its layers as one mesh.

use std::sync::Arc;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::body::{Body, PartRole};
use bespoke::input::diagnostic::{Element, Subject};
use bespoke::input::diagnostic_words::avatar_triangle;
use glam::DVec3;

/// A strip of so many triangles, at this height.
fn strip(triangles: u32, height: f64) -> Arc<TriangleMesh> {
    let at = |k: u32| DVec3::new(f64::from(k / 2), f64::from(k % 2), height);
    let positions = (0..triangles + 2).map(at).collect();
    Arc::new(TriangleMesh { positions, triangles: (0..triangles).map(|k| [k, k + 1, k + 2]).collect() })
}

#[test]
fn triangles_are_the_avatars_or_a_layers() {
    let (avatar, layers) = (strip(3, 0.0), [strip(2, 1.0), strip(4, 2.0)]);
    let body = Body::new(&avatar, &layers).unwrap();
    assert_eq!((body.mesh.positions.len(), body.mesh.triangles.len()), (5 + 4 + 6, 3 + 2 + 4));
    assert_eq!((body.avatar_size(), body.avatar_positions()), ([5, 3], &avatar.positions[..]));
    assert_eq!(body.layer_positions(), [&layers[0].positions[..], &layers[1].positions[..]].concat());
    let mut found = Vec::new();
    for (k, corners) in (0u32..).zip(&body.mesh.triangles) {
        let element = body.triangle(k);
        let own = match element.subject {
            Subject::TargetAvatar => &avatar,
            Subject::Layer(layer) => &layers[layer as usize],
            other => panic!("{other:?}"),
        };
        let expected = own.triangles[element.index as usize].map(|v| own.positions[v as usize]);
        assert_eq!(corners.map(|v| body.mesh.positions[v as usize]), expected);
        found.push((element, avatar_triangle(element)));
    }
    assert_eq!(found[2], (Element::triangle(Subject::TargetAvatar, 2), "avatar triangle 2".into()));
    assert_eq!(found[3], (Element::triangle(Subject::Layer(0), 0), "triangle 0 of layer 0".into()));
    assert_eq!(found[8], (Element::triangle(Subject::Layer(1), 3), "triangle 3 of layer 1".into()));
}

#[test]
fn without_layers_it_is_the_avatar_itself() {
    let avatar = strip(3, 0.0);
    let body = Body::new(&avatar, &[]).unwrap();
    assert!(Arc::ptr_eq(&body.mesh, &avatar));
    assert_eq!(body, Body::from(TriangleMesh::clone(&avatar)));
    assert!(body.layer_positions().is_empty());
    assert_eq!(body.triangle(1), Element::triangle(Subject::TargetAvatar, 1));
}

#[test]
fn roles_leave_triangles_out_and_keep_the_callers_numbers() {
    let (avatar, layers) = (strip(4, 0.0), [strip(2, 1.0)]);
    let roles = [PartRole::Ignored, PartRole::Body, PartRole::Collision, PartRole::Automatic];
    let body = Body::with_roles(&avatar, &layers, &roles).unwrap();
    assert_eq!((body.avatar_size(), body.avatar_positions()), ([6, 3], &avatar.positions[..]));
    assert_eq!(body.mesh.triangles[..3], avatar.triangles[1..]);
    let found: Vec<Element> = (0..5).map(|t| body.triangle(t)).collect();
    let avatars = [1, 2, 3].map(|t| Element::triangle(Subject::TargetAvatar, t));
    let layer = [0, 1].map(|t| Element::triangle(Subject::Layer(0), t));
    assert_eq!(found, [&avatars[..], &layer[..]].concat());
    let fitted = body.fitted().unwrap();
    assert_eq!(fitted.triangles, [&body.mesh.triangles[..1], &body.mesh.triangles[2..]].concat());
    // The roles stay with other positions.
    assert_eq!(body.with_mesh(TriangleMesh::clone(&body.mesh)), body);
    // Nothing is said: it is the avatar itself.
    let plain = Body::with_roles(
        &avatar,
        &[],
        &[PartRole::Automatic, PartRole::Body, PartRole::Automatic, PartRole::Automatic],
    )
    .unwrap();
    assert!(Arc::ptr_eq(&plain.mesh, &avatar) && plain.fitted().is_none());
}
