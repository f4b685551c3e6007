//! Cases that are made: the closet's jacket on its two bodies, and garments of other densities.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::{fs, io, thread};

use crate::case::Case;
use closet::files;
use closet::mesh::Mesh;
use closet::{Kind, Sample, jacket, sample};
use testing::obj::read_mesh;

/// How much coarser than the sample a jacket of about 1000 and one of about 2000 vertices is.
const COARSE: [(u32, f64); 2] = [(1, 1.74), (2, 1.22)];
/// Each of them is subdivided so often.
const SUBDIVISIONS: u32 = 2;

/// Writes the jacket and its two bodies to `folder`.
pub fn write(folder: &Path) -> io::Result<Vec<Case>> {
    let garment = folder.join("jacket");
    thread::scope(|scope| {
        let bodies = [("heavy", Kind::Heavy), ("creature", Kind::Creature)].map(|(name, kind)| {
            let own = folder.join(name);
            scope.spawn(move || write_body(&own, &sample(kind)).map(|()| own))
        });
        let sample = sample(Kind::Jacket);
        write_garment(&garment, &sample, &sample.mesh, &sample.no_fit)?;
        bodies
            .into_iter()
            .map(|body| body.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .map(|avatar| avatar.map(|avatar| Case { garment: garment.clone(), avatar }))
            .collect()
    })
}

/// Writes jackets of about 1000, 2000, 4000, ... 32000 vertices to `folder`. The last four are the first two with every
/// triangle cut in four, so that the shape is the same to the last bit and only the number of unknowns grows.
pub fn write_densities(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut folders = Vec::new();
    for (thousands, coarseness) in COARSE {
        let sample = jacket(coarseness);
        let (mut mesh, mut no_fit) = (sample.mesh.clone(), sample.no_fit.clone());
        for level in 0..=SUBDIVISIONS {
            if level > 0 {
                subdivide(&mut mesh, &mut no_fit);
            }
            let thousands = thousands << (2 * level);
            let own = folder.join(format!("jacket_{thousands}k"));
            write_garment(&own, &sample, &mesh, &no_fit)?;
            folders.push((thousands, own));
        }
    }
    folders.sort();
    Ok(folders.into_iter().map(|(_, own)| own).collect())
}

/// Writes the garment in `source` to `folder` as it is and subdivided once and twice.
pub fn write_subdivided(source: &Path, folder: &Path) -> io::Result<Vec<PathBuf>> {
    let read = read_mesh(&source.join("garment.obj"));
    let mut mesh = Mesh { positions: read.positions, triangles: read.triangles };
    let mut no_fit: Vec<u32> = match fs::read_to_string(source.join("no-fit.txt")) {
        Ok(text) => text.split_whitespace().filter_map(|word| word.parse().ok()).collect(),
        Err(_) => Vec::new(),
    };
    let name = source.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut folders = Vec::new();
    for level in 0..=SUBDIVISIONS {
        if level > 0 {
            subdivide(&mut mesh, &mut no_fit);
        }
        let own = folder.join(format!("{name}_{}x", 1 << (2 * level)));
        fs::create_dir_all(&own)?;
        files::write_mesh(&own.join("garment.obj"), &mesh)?;
        fs::copy(source.join("skeleton.obj"), own.join("skeleton.obj"))?;
        if !no_fit.is_empty() {
            files::write_indices(&own.join("no-fit.txt"), &no_fit)?;
        }
        folders.push(own);
    }
    Ok(folders)
}

fn write_garment(folder: &Path, sample: &Sample, mesh: &Mesh, no_fit: &[u32]) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    files::write_mesh(&folder.join("garment.obj"), mesh)?;
    files::write_skeleton(&folder.join("skeleton.obj"), &sample.skeleton)?;
    files::write_indices(&folder.join("no-fit.txt"), no_fit)
}

fn write_body(folder: &Path, sample: &Sample) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    files::write_mesh(&folder.join("avatar.obj"), &sample.mesh)?;
    files::write_skeleton(&folder.join("skeleton.obj"), &sample.skeleton)?;
    files::write_matrix(&folder.join("skin.txt"), &sample.skin)
}

/// Cuts every triangle into four at the middles of its sides. The middle of two vertices in `no_fit` joins them.
fn subdivide(mesh: &mut Mesh, no_fit: &mut Vec<u32>) {
    let mut is_no_fit = vec![false; mesh.positions.len()];
    no_fit.iter().for_each(|&v| is_no_fit[v as usize] = true);
    let mut middles = HashMap::new();
    let mut triangles = Vec::with_capacity(4 * mesh.triangles.len());
    for &[a, b, c] in &mesh.triangles {
        let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[v, w]| {
            *middles.entry([v.min(w), v.max(w)]).or_insert_with(|| {
                let [p, q] = [v, w].map(|v| mesh.positions[v as usize]);
                mesh.positions.push(p.midpoint(q));
                is_no_fit.push(is_no_fit[v as usize] && is_no_fit[w as usize]);
                mesh.positions.len() as u32 - 1
            })
        });
        triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    mesh.triangles = triangles;
    *no_fit = (0..is_no_fit.len() as u32).filter(|&v| is_no_fit[v as usize]).collect();
}
