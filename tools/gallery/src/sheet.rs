//! The file of a sheet of pictures: a grid of cells, each a scene, which `web/render.mjs` draws.
//!
//! A sheet is two files: `NAME.json`, which is [`Sheet`], and `NAME.bin`, the numbers of its meshes, little-endian 32-bit.
//! Coordinates are in metres, z up, facing -y. Colours are as in CSS.

use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

/// What [`Sheet::format`] says.
pub const FORMAT: &str = "sheet 1";

/// A grid of pictures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sheet {
    /// [`FORMAT`].
    pub format: String,
    /// Above the grid.
    pub title: String,
    /// A sentence below the title.
    pub subtitle: String,
    /// From where all cells are seen that say nothing else.
    pub view: View,
    /// 0: all columns in one scale; 1: each as large as it can be; between: in between.
    pub evenness: f64,
    /// From the left.
    pub columns: Vec<Heading>,
    /// From the top.
    pub rows: Vec<Heading>,
    /// In any order; a place in the grid may be empty.
    pub cells: Vec<Cell>,
    /// What surfaces draw.
    pub meshes: Vec<Mesh>,
    /// For the values of surfaces.
    pub scales: Vec<Scale>,
    #[serde(skip)]
    data: Vec<u8>,
    /// Arrays that are there already: meshes share their triangles.
    #[serde(skip)]
    known: HashMap<Vec<u8>, Array>,
}

/// The name of a column or a row.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Heading {
    /// The name.
    pub label: String,
    /// Smaller, below the label.
    pub note: String,
    /// For rows: the column of the cell that a page can show beside another cell of the row.
    pub reference: Option<usize>,
}

/// A camera that looks at a body from some way off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// Degrees around the vertical; 0 sees the front, 90 the body's left side.
    pub azimuth: f64,
    /// Degrees above the horizon.
    pub elevation: f64,
    /// What is in the middle; the middle of the column where nothing is said.
    pub centre: Option<[f32; 3]>,
    /// Metres from the lower to the upper edge; so that the column fits where nothing is said.
    pub height: Option<f64>,
}

/// A scene at a place in the grid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Counted from 0.
    pub column: usize,
    /// Counted from 0.
    pub row: usize,
    /// Below the picture, in as many lines as it has.
    pub caption: String,
    /// Shown instead of a picture: why there is none.
    pub message: Option<String>,
    /// Names and values, for the page.
    pub figures: Vec<[String; 2]>,
    /// All that is drawn.
    pub layers: Vec<Layer>,
    /// Another view than the sheet's.
    pub view: Option<View>,
}

/// Something to draw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Layer {
    /// A mesh.
    Surface {
        /// What it shows.
        role: Role,
        /// Whether it is seen in the sheet; else a page shows it on demand.
        shown: bool,
        /// An index into [`Sheet::meshes`].
        mesh: usize,
        /// As in CSS.
        colour: String,
        /// 1 hides what is behind.
        opacity: f64,
        /// Draws the edges, too.
        wireframe: bool,
        /// Edges sharper than so many degrees look sharp; the others look smooth.
        crease: f64,
        /// A number a triangle, that colours it instead of `colour`.
        values: Option<Values>,
    },
    /// Straight tubes.
    Lines {
        /// What they show.
        role: Role,
        /// As for surfaces.
        shown: bool,
        /// Three coordinates a point.
        points: Array,
        /// Two indices of points a tube.
        segments: Array,
        /// As in CSS.
        colour: String,
        /// Of a tube, in metres.
        radius: f64,
        /// Draws a ball of the double radius at each point.
        balls: bool,
        /// Seen through everything.
        over: bool,
    },
}

/// What a layer is; a page can hide bodies, skeletons and values, and show the edges of garments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// What is dressed.
    Body,
    /// What it wears.
    Garment,
    /// Joints and bones.
    Skeleton,
    /// As a garment, for what belongs to a figure and stays.
    Mark,
}

/// Numbers that colour triangles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Values {
    /// One number a triangle.
    pub array: Array,
    /// An index into [`Sheet::scales`].
    pub scale: usize,
    /// Whether they are seen in the sheet; else a page shows them on demand.
    pub shown: bool,
}

/// How numbers become colours, with a legend.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale {
    /// The name of the legend.
    pub label: String,
    /// Numbers below have the first colour.
    pub minimum: f64,
    /// Numbers above have the last colour.
    pub maximum: f64,
    /// Whether the colours follow the logarithm.
    pub logarithmic: bool,
    /// `heat`, `depth` or `diverging`.
    pub map: String,
}

/// A run of numbers in the binary file: 32-bit floats, or 32-bit unsigned integers where they are indices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Array {
    /// In bytes.
    pub offset: usize,
    /// How many numbers.
    pub count: usize,
}

/// Triangles in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mesh {
    /// Three coordinates a vertex.
    pub positions: Array,
    /// Three indices a triangle.
    pub triangles: Array,
}

impl Sheet {
    /// Without rows and columns.
    pub fn new(title: &str, subtitle: &str, view: View) -> Self {
        Self { format: FORMAT.into(), title: title.into(), subtitle: subtitle.into(), view, ..Self::default() }
    }

    /// Adds a mesh and returns its index.
    pub fn add_mesh(&mut self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> usize {
        let positions = self.add_floats(positions.as_flattened());
        let triangles = self.add_indices(triangles.as_flattened());
        self.meshes.push(Mesh { positions, triangles });
        self.meshes.len() - 1
    }

    /// Adds numbers.
    pub fn add_floats(&mut self, numbers: &[f32]) -> Array {
        self.add(numbers.iter().flat_map(|n| n.to_le_bytes()).collect())
    }

    /// Adds indices.
    pub fn add_indices(&mut self, indices: &[u32]) -> Array {
        self.add(indices.iter().flat_map(|n| n.to_le_bytes()).collect())
    }

    /// What is there already is not added twice.
    fn add(&mut self, bytes: Vec<u8>) -> Array {
        if let Some(&array) = self.known.get(&bytes) {
            return array;
        }
        let array = Array { offset: self.data.len(), count: bytes.len() / 4 };
        self.data.extend_from_slice(&bytes);
        self.known.insert(bytes, array);
        array
    }

    /// Writes `path` and, beside it, the file of the same name that ends in `.bin`.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        fs::write(path, serde_json::to_string(self)?)?;
        fs::write(path.with_extension("bin"), &self.data)
    }
}
