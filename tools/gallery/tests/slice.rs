//! A slice of the gallery, by the program's own functions: three garments on three bodies, each verified; the table and
//! the sheet say what was measured.

use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::options::Options;
use bespoke::verify::intersections;
use closet::avatars::Avatar;
use closet::garments::Garment;
use gallery::models::Closet;
use gallery::overview;
use gallery::pair::{Outcome, dress};
use gallery::regularity::{asymmetry, opening_growth};
use gallery::sheet::{self, Array, FORMAT, Layer, Sheet, View};
use gallery::table::{self, Summary};
use glam::{DVec3, Vec3};

static CLOSET: LazyLock<Closet> = LazyLock::new(|| {
    let garments = [Garment::Jumpsuit, Garment::Skirt, Garment::Vest];
    Closet::new(&garments, &[Avatar::Child, Avatar::Giant, Avatar::Skeleton])
});

static OUTCOMES: LazyLock<Vec<Outcome>> = LazyLock::new(|| {
    let pairs = CLOSET.garments.iter().flat_map(|worn| CLOSET.avatars.iter().map(move |body| (worn, body)));
    let dressed = pairs.map(|((garment, worn), (avatar, body))| {
        dress([garment.name(), avatar.name()], worn, body, None, &Options::default())
    });
    dressed.collect()
});

/// A sheet as a program reads it that has only the files.
struct Files {
    sheet: Sheet,
    data: Vec<u8>,
    folder: PathBuf,
}

impl Files {
    fn new(name: &str, sheet: &Sheet) -> Self {
        let folder = std::env::temp_dir().join(format!("bespoke-gallery-{}-{name}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        sheet.write(&folder.join("sheet.json")).unwrap();
        let text = fs::read_to_string(folder.join("sheet.json")).unwrap();
        // By way of a value: the numbers of enums are texts to a reader that keeps all their digits, as the file formats' does.
        let sheet: serde_json::Value = serde_json::from_str(&text).unwrap();
        Self {
            sheet: serde_json::from_value(sheet).unwrap(),
            data: fs::read(folder.join("sheet.bin")).unwrap(),
            folder,
        }
    }

    fn words(&self, array: Array) -> Vec<[u8; 4]> {
        self.data[array.offset..][..4 * array.count].chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]).collect()
    }

    fn floats(&self, array: Array) -> Vec<f32> {
        self.words(array).into_iter().map(f32::from_le_bytes).collect()
    }

    fn indices(&self, array: Array) -> Vec<u32> {
        self.words(array).into_iter().map(u32::from_le_bytes).collect()
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

#[test]
fn every_pair_of_the_slice_is_verified() {
    assert_eq!(OUTCOMES.len(), 9);
    for o in OUTCOMES.iter() {
        assert_eq!(o.error, None, "{} on {}", o.garment, o.avatar);
        assert!(o.is_verified(), "{o:?}");
        assert_eq!(o.t, 1.0);
        let [mean, most] = o.distortion.unwrap();
        assert!(0.0 < mean && mean < most && most.is_finite(), "distortion {mean}, at most {most}");
        assert!(o.converged, "{} on {} did not converge", o.garment, o.avatar);
        // What is kept is what was verified: judged once more, as 32-bit positions and apart from the session.
        let (worn, body) = CLOSET.samples(o);
        let positions = o.positions.iter().map(|&p| Vec3::from(p).as_dvec3()).collect();
        let garment = TriangleMesh { positions, triangles: worn.mesh.triangles.clone() };
        let positions = body.mesh.positions.iter().map(|p| p.as_vec3().as_dvec3()).collect();
        let avatar = TriangleMesh { positions, triangles: body.mesh.triangles.clone() };
        assert_eq!(intersections(&garment, None, 0).unwrap().count, 0);
        assert_eq!(intersections(&garment, Some(&avatar), 0).unwrap().count, 0);
    }
}

#[test]
fn the_table_has_a_row_a_pair() {
    let summary = Summary::of(&OUTCOMES, 61.5);
    assert_eq!(summary.sentence(), "9 of 9 pairs without intersections, in 1 min 1 s");
    let text = table::markdown(&OUTCOMES, &summary);
    let rows: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows.len(), 2 + 9);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{text}");
    for (row, o) in rows[2..].iter().zip(OUTCOMES.iter()) {
        let [inflate, fit] = o.iterations;
        let seconds = format!("{:.1}", o.seconds);
        assert_eq!(row[..5], [o.garment, o.avatar, "0 + 0", &seconds, &format!("{inflate} + {fit}")]);
        assert!(inflate > 0 && fit > 0);
    }
    let json: serde_json::Value = serde_json::from_str(&table::json(&OUTCOMES, &summary).unwrap()).unwrap();
    assert_eq!(json["verified"], 9);
    for (row, o) in json["rows"].as_array().unwrap().iter().zip(OUTCOMES.iter()) {
        assert_eq!((row["garment"].as_str(), row["avatar"].as_str()), (Some(o.garment), Some(o.avatar)));
        assert_eq!(row["intersections"], serde_json::json!([0, 0]));
        // Read back by a parser that may miss the last bit.
        match (row["distances"][1].as_f64(), o.distances[1]) {
            (Some(read), Some(written)) => assert!((read / written - 1.0).abs() < 1e-12, "{read} {written}"),
            (read, written) => assert_eq!(read, written),
        }
    }
}

#[test]
fn the_sheet_holds_the_numbers_of_all_pairs() {
    let files = Files::new("all", &overview::sheet(&CLOSET, &OUTCOMES, &Summary::of(&OUTCOMES, 0.0)));
    let sheet = &files.sheet;
    assert_eq!(sheet.format, FORMAT);
    let labels: Vec<&str> = sheet.columns.iter().chain(&sheet.rows).map(|h| h.label.as_str()).collect();
    assert_eq!(labels, ["Mannequin", "Child", "Giant", "Skeleton", "Undressed", "Jumpsuit", "Skirt", "Vest"]);
    assert_eq!(sheet.cells.len(), 16);
    for cell in &sheet.cells {
        let (mut garments, mut distortions) = (Vec::new(), Vec::new());
        for layer in &cell.layers {
            match layer {
                Layer::Surface { role: sheet::Role::Garment, mesh, values, .. } => {
                    garments.push(sheet.meshes[*mesh]);
                    distortions.extend(*values);
                }
                Layer::Surface { mesh, .. } => {
                    let mesh = sheet.meshes[*mesh];
                    let vertices = files.floats(mesh.positions).len() as u32 / 3;
                    assert!(files.indices(mesh.triangles).iter().all(|&v| v < vertices));
                }
                Layer::Lines { points, segments, .. } => {
                    assert_eq!((points.count, segments.count), (45, 28));
                    assert!(files.indices(*segments).iter().all(|&p| p < 15));
                }
            }
        }
        assert_eq!(garments.len(), usize::from(cell.row > 0), "{cell:?}");
        if cell.row > 0 && cell.column > 0 {
            let o = &OUTCOMES[3 * (cell.row - 1) + cell.column - 1];
            let (worn, _) = CLOSET.samples(o);
            assert_eq!(files.floats(garments[0].positions), o.positions.as_flattened());
            assert_eq!(o.distortions.len(), worn.mesh.triangles.len());
            assert_eq!(files.floats(distortions[0].array), o.distortions);
            assert_eq!(files.indices(garments[0].triangles), worn.mesh.triangles.as_flattened());
            assert_eq!(cell.figures, table::figures(o));
        }
    }
}

/// A pair without a result keeps its row and its place, with the sentence.
#[test]
fn a_pair_that_fails_is_a_row_with_a_sentence() {
    let (garment, worn) = &CLOSET.garments[2];
    let (avatar, body) = &CLOSET.avatars[0];
    let mut hurt = worn.clone();
    hurt.mesh.triangles[7][1] = u32::MAX;
    let outcome = dress([garment.name(), avatar.name()], &hurt, body, None, &Options::default());
    let sentence = outcome.error.clone().unwrap();
    assert!(sentence.contains("triangle 7"), "{sentence}");
    assert!(!outcome.is_verified() && outcome.positions.is_empty());
    let outcomes = [outcome];
    let summary = Summary::of(&outcomes, 0.0);
    assert_eq!((summary.pairs, summary.verified), (1, 0));
    assert!(table::markdown(&outcomes, &summary).contains(&sentence));
    let sheet = overview::sheet(&CLOSET, &outcomes, &summary);
    let told = |cell: &&sheet::Cell| cell.message.as_deref() == Some(sentence.as_str()) && cell.layers.is_empty();
    assert_eq!(sheet.cells.iter().filter(told).map(|c| [c.column, c.row]).collect::<Vec<_>>(), [[1, 3]]);
}

/// Meshes of one topology share their triangles in the file.
#[test]
fn equal_arrays_are_stored_once() {
    let mut sheet = Sheet::new("", "", View::default());
    let (low, high) = ([[0.0, 0.5, -1.0], [1e-30, 2.0, 3.0], [4.0, 5.0, 6.0]], [[7.0; 3], [8.0; 3], [9.0; 3]]);
    let meshes = [low, high, low].map(|positions| sheet.add_mesh(&positions, &[[0, 1, 2]]));
    assert_eq!(meshes, [0, 1, 2]);
    let files = Files::new("equal", &sheet);
    assert_eq!(files.data.len(), 4 * (9 + 3 + 9));
    assert_eq!(files.sheet.meshes[0], files.sheet.meshes[2]);
    assert_eq!(files.floats(files.sheet.meshes[1].positions), high.as_flattened());
    assert_eq!(files.indices(files.sheet.meshes[1].triangles), [0, 1, 2]);
}

#[test]
fn the_measures_of_regularity_are_those_of_shapes_that_are_known() {
    // A tent over a square, open at the bottom, whose top is 0.3 off the plane in which it is mirrored.
    let base = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
    let tent = |top: f64| {
        let positions = base.into_iter().chain([DVec3::new(top, 0.0, 1.0)]).collect();
        TriangleMesh { positions, triangles: vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]] }
    };
    assert_eq!(asymmetry(&tent(0.0)), 0.0);
    // Of five vertices one has no mirror image: 0.6 beside the top, and so far from the flat side.
    let off = 0.6 / f64::hypot(1.0, 1.3) / 5.0;
    assert!((asymmetry(&tent(0.3)) - off).abs() < 1e-12, "{} {off}", asymmetry(&tent(0.3)));

    let scaled: Vec<DVec3> = tent(0.0).positions.iter().map(|&p| 3.0 * p + DVec3::X).collect();
    let [least, most] = opening_growth(&tent(0.0), &scaled).unwrap();
    assert!((least - 1.0).abs() < 1e-12 && least == most);
    // A top four times as high: areas grow by sqrt(17 / 2), the opening does not.
    let high: Vec<DVec3> = tent(0.0).positions.iter().map(|&p| p * DVec3::new(1.0, 1.0, 4.0)).collect();
    let [least, _] = opening_growth(&tent(0.0), &high).unwrap();
    assert!((least - (2.0f64 / 17.0).powf(0.25)).abs() < 1e-12, "{least}");
}
