//! What scripts and artists say of single vertices of the garment: numbers, lists, or what is painted on the mesh.

use std::collections::HashMap;

use godot::builtin::{
    AnyArray, PackedByteArray, PackedColorArray, PackedFloat32Array, PackedFloat64Array, PackedInt32Array,
    PackedInt64Array, Variant, VariantType,
};
use godot::classes::mesh::ArrayType;

use crate::mesh::{Arrays, Surface, array};
use crate::session::{Failure, Result};

/// A vertex whose paint is above this is meant.
const MEANT: f32 = 0.5;

/// A number for each vertex: from an array of them, or from a channel that is painted. Nil is none.
///
/// # Errors
/// It is something else, has another length, or names a channel that the mesh does not have.
pub fn numbers(value: &Variant, mesh: &Arrays, what: &str) -> Result<Option<Vec<f32>>> {
    if value.is_nil() {
        return Ok(None);
    }
    if let Some(name) = channel_name(value) {
        return channel(mesh, &name, 1.0, what).map(Some);
    }
    let found: Option<Vec<f32>> = match value.get_type() {
        VariantType::PACKED_FLOAT32_ARRAY => Some(value.to::<PackedFloat32Array>().to_vec()),
        VariantType::PACKED_FLOAT64_ARRAY => {
            Some(value.to::<PackedFloat64Array>().as_slice().iter().map(|&number| number as f32).collect())
        }
        _ => listed(value, |one| one.try_to_relaxed::<f64>().ok().map(|number| number as f32)),
    };
    let found = found.ok_or_else(|| {
        Failure::argument(format!("{what}: it is no array of numbers, and no channel such as \"color.r\""))
    })?;
    let count = mesh.positions.len();
    if found.len() != count {
        return Err(Failure::argument(format!(
            "{what}: there are {} numbers for the {count} vertices of all surfaces",
            found.len()
        )));
    }
    Ok(Some(found))
}

/// Vertices of the mesh: from a list, or those that are painted in a channel.
///
/// # Errors
/// As for `numbers`; a vertex that the mesh does not have.
pub fn vertices(value: &Variant, mesh: &Arrays, what: &str) -> Result<Vec<u32>> {
    if value.is_nil() {
        return Ok(Vec::new());
    }
    if let Some(name) = channel_name(value) {
        let paint = channel(mesh, &name, 0.0, what)?;
        return Ok((0..).zip(paint).filter(|&(_, paint)| paint > MEANT).map(|(vertex, _)| vertex).collect());
    }
    let found: Option<Vec<i64>> = match value.get_type() {
        VariantType::PACKED_INT32_ARRAY => {
            Some(value.to::<PackedInt32Array>().as_slice().iter().map(|&vertex| i64::from(vertex)).collect())
        }
        VariantType::PACKED_INT64_ARRAY => Some(value.to::<PackedInt64Array>().to_vec()),
        _ => listed(value, |one| one.try_to::<i64>().ok()),
    };
    let found = found.ok_or_else(|| {
        Failure::argument(format!("{what}: it is no array of vertices, and no channel such as \"color.r\""))
    })?;
    let count = mesh.positions.len();
    let vertex = |vertex: i64| {
        u32::try_from(vertex).ok().filter(|&vertex| (vertex as usize) < count).ok_or_else(|| {
            Failure::argument(format!("{what}: there is no vertex {vertex}; the garment has {count} over all surfaces"))
        })
    };
    found.into_iter().map(vertex).collect()
}

/// Groups of vertices: a list is one, and what is painted falls into its connected pieces.
///
/// # Errors
/// As for `vertices`; none is painted, or listed.
pub fn groups(value: &Variant, mesh: &Arrays, what: &str) -> Result<Vec<Vec<u32>>> {
    let found = vertices(value, mesh, what)?;
    if found.is_empty() {
        return Err(Failure::argument(format!("{what}: there is no vertex in it")));
    }
    Ok(if channel_name(value).is_some() { pieces(&found, mesh) } else { vec![found] })
}

/// What an array of any values holds, if it is one and all are of one kind.
fn listed<T>(value: &Variant, read: impl Fn(Variant) -> Option<T>) -> Option<Vec<T>> {
    let list = (value.get_type() == VariantType::ARRAY).then(|| value.to::<AnyArray>())?;
    list.iter_shared().map(read).collect()
}

/// The name of a channel, where it is one.
fn channel_name(value: &Variant) -> Option<String> {
    matches!(value.get_type(), VariantType::STRING | VariantType::STRING_NAME).then(|| value.to_string())
}

/// A channel of all surfaces: "color.r" to "color.a", "custom0.x" to "custom3.w". A surface without it counts as `unpainted`.
fn channel(mesh: &Arrays, name: &str, unpainted: f32, what: &str) -> Result<Vec<f32>> {
    let unknown = || {
        Failure::argument(format!(
            "{what}: '{name}' is no channel; there are color.r, color.g, color.b, color.a, and custom0.x to custom3.w"
        ))
    };
    let (array, part) = name.split_once('.').ok_or_else(unknown)?;
    let parts = if array == "color" { "rgba" } else { "xyzw" };
    let part = parts.find(part).filter(|_| part.len() == 1).ok_or_else(unknown)?;
    let which = match array {
        "color" => None,
        _ => Some(
            ["custom0", "custom1", "custom2", "custom3"].iter().position(|one| *one == array).ok_or_else(unknown)?,
        ),
    };
    let mut numbers = Vec::with_capacity(mesh.positions.len());
    let mut is_there = false;
    for surface in &mesh.surfaces {
        let painted = match which {
            None => colors(surface, part),
            Some(custom) => customs(surface, custom, part),
        };
        is_there |= painted.is_some();
        numbers.extend(painted.unwrap_or_else(|| vec![unpainted; surface.vertices]));
    }
    if !is_there {
        return Err(Failure::argument(format!(
            "{what}: no surface of the garment has the channel '{name}', in bytes or in numbers of 32 bits"
        )));
    }
    Ok(numbers)
}

fn colors(surface: &Surface, part: usize) -> Option<Vec<f32>> {
    let colors: PackedColorArray = array(&surface.arrays, ArrayType::COLOR)?;
    let channel = |color: &godot::builtin::Color| [color.r, color.g, color.b, color.a][part];
    Some(colors.as_slice().iter().map(channel).collect()).filter(|all: &Vec<f32>| all.len() == surface.vertices)
}

/// A custom channel, by the format in which the surface keeps it.
fn customs(surface: &Surface, custom: usize, part: usize) -> Option<Vec<f32>> {
    let which = [ArrayType::CUSTOM0, ArrayType::CUSTOM1, ArrayType::CUSTOM2, ArrayType::CUSTOM3][custom];
    let format = surface.format >> (13 + 3 * custom) & 7;
    let all: Vec<f32> = match format {
        0 | 1 => {
            let bytes: PackedByteArray = array(&surface.arrays, which)?;
            let number = |byte: u8| match format {
                0 => f32::from(byte) / 255.0,
                _ => (f32::from(byte as i8) / 127.0).max(-1.0),
            };
            bytes.as_slice().as_chunks::<4>().0.iter().map(|four| number(four[part])).collect()
        }
        4..=7 => {
            let numbers: PackedFloat32Array = array(&surface.arrays, which)?;
            let width = format as usize - 3;
            numbers.as_slice().chunks_exact(width).map(|some| some.get(part).copied()).collect::<Option<_>>()?
        }
        // Halves of 16 bits.
        _ => return None,
    };
    (all.len() == surface.vertices).then_some(all)
}

/// The connected pieces of vertices, by the edges between them. Those in one place are one: a mesh is split along its seams.
fn pieces(chosen: &[u32], mesh: &Arrays) -> Vec<Vec<u32>> {
    let mut places = HashMap::new();
    let mut above: HashMap<u32, u32> = HashMap::new();
    for &vertex in chosen {
        let place = mesh.positions[vertex as usize].map(f32::to_bits);
        above.insert(vertex, *places.entry(place).or_insert(vertex));
    }
    fn root(above: &mut HashMap<u32, u32>, mut vertex: u32) -> u32 {
        while above[&vertex] != vertex {
            let next = above[&above[&vertex]];
            above.insert(vertex, next);
            vertex = next;
        }
        vertex
    }
    for corners in &mesh.triangles {
        let inside: Vec<u32> = corners.iter().copied().filter(|corner| above.contains_key(corner)).collect();
        for pair in inside.windows(2) {
            let (one, other) = (root(&mut above, pair[0]), root(&mut above, pair[1]));
            above.insert(one.max(other), one.min(other));
        }
    }
    let mut found: Vec<(u32, Vec<u32>)> = Vec::new();
    for &vertex in chosen {
        let root = root(&mut above, vertex);
        match found.iter_mut().find(|(other, _)| *other == root) {
            Some((_, piece)) => piece.push(vertex),
            None => found.push((root, vec![vertex])),
        }
    }
    found.into_iter().map(|(_, piece)| piece).collect()
}
