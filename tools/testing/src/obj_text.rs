//! OBJ files that tests write.

/// Vertices, triangles and bones as an OBJ file; every 32-bit number survives.
pub fn obj(vertices: &[[f32; 3]], triangles: &[[u32; 3]], bones: &[[u32; 2]]) -> String {
    let lines = |key: &str, rows: Vec<Vec<String>>| -> String {
        rows.iter().map(|row| format!("{key} {}\n", row.join(" "))).collect()
    };
    let next = |v: &u32| (v + 1).to_string();
    lines("v", vertices.iter().map(|p| p.iter().map(f32::to_string).collect()).collect())
        + &lines("f", triangles.iter().map(|t| t.iter().map(next).collect()).collect())
        + &lines("l", bones.iter().map(|b| b.iter().map(next).collect()).collect())
}
