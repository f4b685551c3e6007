//! The outfit that garments belong to: in which order they are worn, and which triangles pass through each other.

use std::sync::Arc;

use super::Session;
use crate::control::Cancel;
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::outfit::{OutfitOrder, outfit_order};
use crate::verify::intersections_with_cancel;

impl Session {
    /// A garment of the outfit as it was modelled, in the source coordinate system; one more. They are numbered from 0.
    ///
    /// # Errors
    /// `InvalidMesh`, `InvalidState`.
    pub fn add_outfit_garment(&mut self, mesh: TriangleMesh) -> Result<()> {
        self.setting("a garment of the outfit")?;
        mesh.check(&format!("outfit garment {}", self.outfit_size()))?;
        self.inputs.outfit.push(Arc::new(mesh));
        self.outfit_order = None;
        Ok(())
    }

    /// Removes all garments of the outfit.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn clear_outfit(&mut self) -> Result<()> {
        self.setting("the outfit")?;
        self.inputs.outfit.clear();
        self.outfit_order = None;
        Ok(())
    }

    /// Garments of the outfit.
    pub fn outfit_size(&self) -> usize {
        self.inputs.outfit.len()
    }

    /// In which order the garments of the outfit are worn on the source avatar, where one is set. In any stage.
    ///
    /// # Errors
    /// `Cancelled`, `NoThread`.
    pub fn outfit_order(&mut self) -> Result<Arc<OutfitOrder>> {
        let body = self.inputs.source_avatar.clone();
        let is_of = |known: &(Option<Arc<TriangleMesh>>, Arc<OutfitOrder>)| match (&known.0, &body) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        if let Some(known) = self.outfit_order.as_ref().filter(|known| is_of(known)) {
            return Ok(known.1.clone());
        }
        let (outfit, wearer) = (self.inputs.outfit.clone(), body.clone());
        let find = move |cancel: &Cancel| {
            let garments: Vec<&TriangleMesh> = outfit.iter().map(|garment| &**garment).collect();
            Ok(outfit_order(&garments, wearer.as_deref(), cancel)?)
        };
        let order = Arc::new(self.aside(find)?);
        self.outfit_order = Some((body, order.clone()));
        Ok(order)
    }

    /// The pairs of triangles of `a` and `b` that touch or cross, ascending, or those within `a`, by the exact verifier; in any
    /// stage. What counts within one mesh is told at [`crate::verify::intersections`].
    ///
    /// # Errors
    /// `InvalidMesh`, `Cancelled`, `NoThread`.
    pub fn intersecting_pairs(&self, a: TriangleMesh, b: Option<TriangleMesh>) -> Result<Vec<[u32; 2]>> {
        a.check("first mesh")?;
        if let Some(b) = &b {
            b.check("second mesh")?;
        }
        let find = move |cancel: &Cancel| intersections_with_cancel(&a, b.as_ref(), usize::MAX, cancel);
        Ok(self.aside(find)?.pairs)
    }
}
