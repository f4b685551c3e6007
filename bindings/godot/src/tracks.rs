//! Animations of blend shapes: what moves those of the body and of the design moves those of the result, too.

use godot::builtin::{NodePath, PackedStringArray, StringName, Variant};
use godot::classes::{Node, Node3D, Object};
use godot::obj::Gd;

use crate::engine::{ask, ask_object, is};
use crate::findings::Scene;
use crate::session::{Failure, Result};

/// `Animation.TYPE_BLEND_SHAPE`.
const BLEND_SHAPE: i64 = 4;

/// Adds to the animations of an AnimationPlayer tracks for `garment`, beside those that move a blend shape of its design, or one of
/// the avatar that it answers. Tracks that are there stay. How many were added.
///
/// # Errors
/// `player` is no AnimationPlayer, or `garment` no MeshInstance3D in its scene.
pub fn add(player: Option<Gd<Node>>, garment: Option<Gd<Node3D>>, scene: &Scene) -> Result<i64> {
    let player = player
        .filter(|player| is(player, "AnimationPlayer"))
        .ok_or_else(|| Failure::argument("add_blend_shape_tracks: it is no AnimationPlayer"))?;
    let garment = garment
        .filter(|garment| is(garment, "MeshInstance3D"))
        .ok_or_else(|| Failure::argument("add_blend_shape_tracks: the garment is no MeshInstance3D"))?;
    let root = ask_object::<Node>(&player, "get_node_or_null", &[player.get("root_node")])
        .filter(|_| garment.is_inside_tree())
        .ok_or_else(|| {
            Failure::argument("add_blend_shape_tracks: player and garment are in no scene; add the garment to it first")
        })?;
    let path = root.get_path_to(&garment).to_string();
    let mut added = 0;
    let names: PackedStringArray = ask(&player, "get_animation_list", &[]);
    for name in names.as_slice() {
        let name = Variant::from(StringName::from(name));
        let Some(mut animation) = ask_object::<Object>(&player, "get_animation", &[name]) else { continue };
        let count: i64 = ask(&animation, "get_track_count", &[]);
        for track in 0..count {
            let Some(shape) = shape(&animation, track, &root, scene) else { continue };
            let own: i64 = ask(&garment, "find_blend_shape_by_name", &[Variant::from(StringName::from(&shape))]);
            let there = Variant::from(NodePath::from(&format!("{path}:{shape}")));
            let known: i64 = ask(&animation, "find_track", &[there.clone(), Variant::from(BLEND_SHAPE)]);
            if own < 0 || known >= 0 {
                continue;
            }
            let to = Variant::from(animation.clone());
            animation.call("copy_track", &[Variant::from(track), to]);
            let last: i64 = ask::<i64>(&animation, "get_track_count", &[]) - 1;
            animation.call("track_set_path", &[Variant::from(last), there]);
            animation.call("track_set_imported", &[Variant::from(last), Variant::from(false)]);
            added += 1;
        }
    }
    Ok(added)
}

/// The blend shape that a track moves, where it is one of the design's, or of the avatar's that are answered.
fn shape(animation: &Gd<Object>, track: i64, root: &Gd<Node>, scene: &Scene) -> Option<String> {
    let track = [Variant::from(track)];
    if ask::<i64>(animation, "track_get_type", &track) != BLEND_SHAPE {
        return None;
    }
    let path: NodePath = ask(animation, "track_get_path", &track);
    let name = path.get_concatenated_subnames().to_string();
    let node = root.get_node_or_null(&NodePath::from(&path.get_concatenated_names()))?.try_cast::<Node3D>().ok()?;
    let is_of = |parts: &[crate::figure::Part]| {
        parts.iter().any(|part| part.shown.node.and_then(crate::engine::Node::get).as_ref() == Some(&node))
    };
    let is_own = is_of(&scene.garment.parts) && scene.garment.shapes.iter().any(|shape| shape.name == name);
    let is_answered = is_of(&scene.avatar.parts) && scene.avatar.answered.iter().any(|shape| shape.name == name);
    (is_own || is_answered).then_some(name)
}
