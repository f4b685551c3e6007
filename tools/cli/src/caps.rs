//! Which triangles of a garment are caps of its openings, through which the body goes by design: files that this program has
//! written say so, and of others it is found out as it is for a fit.

use serde_json::{Value, json};

use crate::figure::{Figure, Part};
use crate::outfit::Garment;
use crate::own_body::on_own_body;

/// In the extras of a primitive: the triangles of its caps, as they are counted there.
const KEY: &str = "bespoke_caps";

/// Notes the triangles of the caps of `primitive`. What it said of caps before is of another fit.
pub fn write(primitive: &mut Value, triangles: Vec<u32>) {
    let extras = primitive.get_mut("extras").map(Value::as_object_mut);
    match extras {
        Some(Some(extras)) => {
            extras.shift_remove(KEY);
            if !triangles.is_empty() {
                extras.insert(KEY.into(), triangles.into());
            } else if extras.is_empty() {
                primitive.as_object_mut().map(|primitive| primitive.shift_remove("extras"));
            }
        }
        // Extras that are no object are somebody else's.
        Some(None) => {}
        None if triangles.is_empty() => {}
        None => primitive["extras"] = json!({ KEY: triangles }),
    }
}

/// What the file says of the caps of a part; none where it says nothing.
fn noted(figure: &Figure, part: &Part) -> Option<Vec<u32>> {
    let primitive = &figure.document.json()["meshes"][part.mesh]["primitives"][part.primitive.index];
    let list = primitive.get("extras")?.get(KEY)?.as_array()?;
    list.iter().map(|t| t.as_u64().filter(|t| *t < part.triangles.len() as u64).map(|t| t as u32)).collect()
}

/// For each triangle of a garment, part after part, whether it is of a cap.
pub fn of_garment(figure: &Figure, garment: &Garment) -> Vec<bool> {
    let parts: Vec<&Part> = garment.parts.iter().map(|&part| &figure.parts[part]).collect();
    let mut is_cap = vec![false; parts.iter().map(|part| part.triangles.len()).sum()];
    let said: Vec<Option<Vec<u32>>> = parts.iter().map(|part| noted(figure, part)).collect();
    if said.iter().all(Option::is_none) {
        // A body that the library refuses, or that is not there, tells of none.
        let found = on_own_body(figure, garment, |job| job.caps()).ok().flatten().unwrap_or_default();
        found.into_iter().for_each(|t| is_cap[t as usize] = true);
        return is_cap;
    }
    let mut first = 0;
    for (part, own) in parts.iter().zip(said) {
        own.into_iter().flatten().for_each(|t| is_cap[first + t as usize] = true);
        first += part.triangles.len();
    }
    is_cap
}
