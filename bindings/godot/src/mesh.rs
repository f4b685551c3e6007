//! What a mesh of the engine holds, as plain arrays.

use godot::builtin::{
    PackedByteArray, PackedFloat32Array, PackedInt32Array, PackedVector3Array, VarArray, VarDictionary, Variant,
};
use godot::classes::mesh::{ArrayType, BlendShapeMode, PrimitiveType};
use godot::classes::{ArrayMesh, Mesh, Object, RenderingServer};
use godot::meta::FromGodot;
use godot::obj::{EngineBitfield, EngineEnum, Gd, Singleton};

use crate::session::{Failure, Result};

/// A surface as the engine has it; what is not touched goes over to the result.
pub struct Surface {
    /// All its arrays.
    pub arrays: VarArray,
    /// Format of the arrays.
    pub format: u64,
    /// Levels of detail: the edge length from which on each is drawn, and its indices.
    pub lods: Vec<(f32, PackedInt32Array)>,
    /// Its material.
    pub material: Variant,
    /// Its name.
    pub name: String,
    /// Its vertices are these of the mesh.
    pub first_vertex: usize,
    /// How many they are.
    pub vertices: usize,
    /// Its triangles are these of the mesh.
    pub first_triangle: usize,
    /// How many they are.
    pub triangles: usize,
}

/// A blend shape: what it adds to vertices, normals and tangents, for all vertices of the mesh.
#[derive(Clone, Default)]
pub struct BlendShape {
    /// Its name.
    pub name: String,
    /// Offsets of vertices.
    pub offsets: Vec<[f32; 3]>,
    /// Normals at weight 1; empty where there are none.
    pub normals: Vec<[f32; 3]>,
    /// Tangents at weight 1; empty where there are none.
    pub tangents: Vec<[f32; 4]>,
}

/// A mesh: its surfaces one after the other.
#[derive(Default)]
pub struct Arrays {
    /// Its surfaces.
    pub surfaces: Vec<Surface>,
    /// Vertices in the mesh's own space.
    pub positions: Vec<[f32; 3]>,
    /// Triangles, in the engine's winding.
    pub triangles: Vec<[u32; 3]>,
    /// One for each vertex, or none where a surface has none.
    pub normals: Vec<[f32; 3]>,
    /// One for each vertex, or none where a surface has none.
    pub tangents: Vec<[f32; 4]>,
    /// Binds of each vertex, so many each; 0 where no surface has any.
    pub width: usize,
    /// Binds, vertex after vertex.
    pub binds: Vec<u32>,
    /// Their weights; all zero where a surface has none.
    pub weights: Vec<f32>,
    /// Blend shapes.
    pub shapes: Vec<BlendShape>,
    /// How blend shapes are kept.
    pub relative: bool,
}

/// One of a surface's arrays, where it is there and of this type.
pub fn array<T: FromGodot>(arrays: &VarArray, which: ArrayType) -> Option<T> {
    arrays.get(which.ord() as usize)?.try_to::<T>().ok()
}

fn points(array: &PackedVector3Array) -> impl Iterator<Item = [f32; 3]> + '_ {
    array.as_slice().iter().map(|v| [v.x, v.y, v.z])
}

fn quadruples(numbers: &PackedFloat32Array) -> impl Iterator<Item = [f32; 4]> + '_ {
    numbers.as_slice().as_chunks::<4>().0.iter().copied()
}

impl Arrays {
    /// Reads a mesh. `what` is it in words, for messages.
    ///
    /// # Errors
    /// A surface that is not of triangles, or has no vertices.
    pub fn read(mesh: &Gd<Mesh>, what: &str) -> Result<Self> {
        let mut read = Self { relative: true, ..Self::default() };
        let array_mesh = mesh.clone().try_cast::<ArrayMesh>().ok();
        if let Some(mesh) = &array_mesh {
            read.relative = mesh.get_blend_shape_mode() == BlendShapeMode::RELATIVE;
            let names = (0..mesh.get_blend_shape_count()).map(|k| mesh.get_blend_shape_name(k).to_string());
            read.shapes = names.map(|name| BlendShape { name, ..BlendShape::default() }).collect();
        }
        let count = mesh.get_surface_count();
        let widths = (0..count).map(|k| width(&mesh.surface_get_arrays(k)));
        read.width = widths.max().unwrap_or(0);
        for k in 0..count {
            read.add_surface(mesh, k, what)?;
        }
        if read.triangles.is_empty() {
            return Err(Failure::mesh(format!("{what}: there are no triangles in its mesh")));
        }
        let vertices = read.positions.len();
        if read.normals.len() != vertices {
            read.normals.clear();
        }
        if read.tangents.len() != vertices || read.normals.is_empty() {
            read.tangents.clear();
        }
        for shape in &mut read.shapes {
            if shape.normals.len() != vertices || read.normals.is_empty() {
                shape.normals.clear();
            }
            if shape.tangents.len() != vertices || read.tangents.is_empty() {
                shape.tangents.clear();
            }
        }
        Ok(read)
    }

    fn add_surface(&mut self, mesh: &Gd<Mesh>, k: i32, what: &str) -> Result<()> {
        // All other meshes of the engine are made of triangles.
        let array_mesh = mesh.clone().try_cast::<ArrayMesh>().ok();
        let primitive = array_mesh.as_ref().map(|mesh| mesh.surface_get_primitive_type(k));
        if primitive.is_some_and(|primitive| primitive != PrimitiveType::TRIANGLES) {
            return Err(Failure::mesh(format!("{what}: surface {k} is not made of triangles")));
        }
        let arrays = mesh.surface_get_arrays(k);
        let vertices: PackedVector3Array = array(&arrays, ArrayType::VERTEX)
            .ok_or_else(|| Failure::mesh(format!("{what}: surface {k} has no vertices")))?;
        let (first, count) = (self.positions.len(), vertices.len());
        self.positions.extend(points(&vertices));
        if let Some(normals) = array::<PackedVector3Array>(&arrays, ArrayType::NORMAL) {
            self.normals.extend(points(&normals));
        }
        if let Some(tangents) = array::<PackedFloat32Array>(&arrays, ArrayType::TANGENT) {
            self.tangents.extend(quadruples(&tangents));
        }
        let indices = array::<PackedInt32Array>(&arrays, ArrayType::INDEX).filter(|indices| !indices.is_empty());
        let indices: Vec<u32> = match indices {
            Some(indices) => indices.as_slice().iter().map(|&v| v as u32).collect(),
            None => (0..count as u32).collect(),
        };
        let first_triangle = self.triangles.len();
        let offset = |corners: &[u32; 3]| corners.map(|v| v.saturating_add(first as u32));
        self.triangles.extend(indices.as_chunks::<3>().0.iter().map(offset));
        self.add_weights(&arrays, count);
        self.add_shapes(mesh, k, count);
        let material = mesh.clone().upcast::<Object>().call("surface_get_material", &[Variant::from(k)]);
        self.surfaces.push(Surface {
            format: array_mesh.as_ref().map_or(0, |mesh| mesh.surface_get_format(k).ord()),
            name: array_mesh.as_ref().map(|mesh| mesh.surface_get_name(k).to_string()).unwrap_or_default(),
            lods: lods(mesh, k),
            arrays,
            material,
            first_vertex: first,
            vertices: count,
            first_triangle,
            triangles: self.triangles.len() - first_triangle,
        });
        Ok(())
    }

    fn add_weights(&mut self, arrays: &VarArray, count: usize) {
        let own = width(arrays);
        let read = |array: Option<PackedInt32Array>| array.map(|a| a.to_vec()).unwrap_or_default();
        let binds = read(array(arrays, ArrayType::BONES));
        let weights = array::<PackedFloat32Array>(arrays, ArrayType::WEIGHTS).map(|a| a.to_vec()).unwrap_or_default();
        for vertex in 0..count {
            for k in 0..self.width {
                let at = vertex * own + k;
                let is_there = k < own && at < weights.len();
                self.binds.push(if is_there { binds[at] as u32 } else { 0 });
                self.weights.push(if is_there { weights[at] } else { 0.0 });
            }
        }
    }

    fn add_shapes(&mut self, mesh: &Gd<Mesh>, k: i32, count: usize) {
        if self.shapes.is_empty() {
            return;
        }
        let first = self.positions.len() - count;
        let all = mesh.surface_get_blend_shape_arrays(k);
        for (shape, arrays) in self.shapes.iter_mut().zip(all.iter_shared()) {
            let base = &self.positions[first..];
            let moved: PackedVector3Array = array(&arrays, ArrayType::VERTEX).unwrap_or_default();
            let offset = |v: usize| {
                let to = moved.get(v).map_or(base[v], |p| [p.x, p.y, p.z]);
                if self.relative { to } else { std::array::from_fn(|axis| to[axis] - base[v][axis]) }
            };
            shape.offsets.extend((0..count).map(offset));
            let normals: PackedVector3Array = array(&arrays, ArrayType::NORMAL).unwrap_or_default();
            let is_whole = normals.len() == count && self.normals.len() == first + count;
            if is_whole {
                let base = &self.normals[first..];
                let turned = points(&normals).zip(base);
                let relative = self.relative;
                shape.normals.extend(
                    turned.map(|(n, base)| if relative { std::array::from_fn(|axis| base[axis] + n[axis]) } else { n }),
                );
            }
            let tangents: PackedFloat32Array = array(&arrays, ArrayType::TANGENT).unwrap_or_default();
            if is_whole && tangents.len() == 4 * count && self.tangents.len() == first + count {
                let base = &self.tangents[first..];
                let relative = self.relative;
                shape.tangents.extend(quadruples(&tangents).zip(base).map(|(t, base)| {
                    if relative {
                        [base[0] + t[0], base[1] + t[1], base[2] + t[2], base[3]]
                    } else {
                        [t[0], t[1], t[2], base[3]]
                    }
                }));
            }
        }
    }
}

/// Binds a vertex.
fn width(arrays: &VarArray) -> usize {
    let vertices = array::<PackedVector3Array>(arrays, ArrayType::VERTEX).map_or(0, |v| v.len());
    let weights = array::<PackedFloat32Array>(arrays, ArrayType::WEIGHTS).map_or(0, |w| w.len());
    weights.checked_div(vertices).unwrap_or(0)
}

/// The levels of detail of a surface, which only the server tells.
fn lods(mesh: &Gd<Mesh>, k: i32) -> Vec<(f32, PackedInt32Array)> {
    if mesh.clone().try_cast::<ArrayMesh>().is_err() {
        return Vec::new();
    }
    let surface = RenderingServer::singleton().mesh_get_surface(mesh.get_rid(), k);
    let vertices: i64 = surface.get("vertex_count").and_then(|n| n.try_to().ok()).unwrap_or(0);
    let listed: VarArray = match surface.get("lods") {
        Some(lods) => lods.try_to().unwrap_or_default(),
        None => return Vec::new(),
    };
    let lod = |one: Variant| {
        let one = one.try_to::<VarDictionary>().ok()?;
        let length: f32 = one.get("edge_length")?.try_to_relaxed().ok()?;
        let bytes: PackedByteArray = one.get("index_data")?.try_to().ok()?;
        let bytes = bytes.as_slice();
        let indices: PackedInt32Array = if vertices <= 0xffff {
            bytes.as_chunks::<2>().0.iter().map(|&b| i32::from(u16::from_le_bytes(b))).collect()
        } else {
            bytes.as_chunks::<4>().0.iter().map(|&b| i32::from_le_bytes(b)).collect()
        };
        Some((length, indices))
    };
    listed.iter_shared().filter_map(lod).collect()
}
