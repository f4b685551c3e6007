//! Every outfit on every avatar: results of single calls, none twice, and on from where it was stopped.

use std::fs;
use std::path::Path;

use bespoke_cli::batch::journal::Line;
use bespoke_cli::batch::manifest::Manifest;

use super::files::folder;
use super::{AVATAR, OUTFIT, bespoke, ends};

fn lines(report: &Path) -> Vec<Line> {
    fs::read_to_string(report).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn manifest(folder: &Path, text: &str) {
    fs::write(folder.join("all.json"), text).unwrap();
}

#[test]
fn batch() {
    let folder = folder("batch");
    fs::write(folder.join("outfit.glb"), &*OUTFIT).unwrap();
    fs::write(folder.join("slim.glb"), &*AVATAR).unwrap();
    fs::write(folder.join("broken.glb"), b"no character").unwrap();
    manifest(
        &folder,
        r#"{
            "outfits": [{ "file": "outfit.glb", "name": "vest" }],
            "avatars": ["broken.glb", "slim.glb"],
            "output": "results/{outfit}-on-{avatar}.glb",
            "options": { "fit": 3, "keep": "outfit" }
        }"#,
    );
    let report = folder.join("all.report.jsonl");
    let result = folder.join("results/vest-on-slim.glb");
    let run = bespoke(&folder, &["batch", "all.json"]);
    // A failure does not stop it, and is what it ends with.
    ends(&run, 1);
    let mut first = lines(&report);
    first.sort_by(|a, b| a.pair.cmp(&b.pair));
    assert_eq!([&first[0].pair, &first[1].pair], ["vest on broken", "vest on slim"]);
    assert!(first[0].exit == 1 && first[0].output.is_none() && first[0].said.contains("broken.glb"), "{:?}", first[0]);
    assert_eq!((first[1].exit, first[1].output.as_deref()), (0, Some(Path::new("results/vest-on-slim.glb"))));

    // The same bytes as by itself.
    let alone = ["dress", "outfit.glb", "slim.glb", "-o", "alone.glb", "--fit", "3", "--keep", "outfit", "-q"];
    ends(&bespoke(&folder, &alone), 0);
    let bytes = fs::read(&result).unwrap();
    assert!(fs::read(folder.join("alone.glb")).unwrap() == bytes, "the result differs from that of a single call");

    // Nothing is done twice.
    ends(&bespoke(&folder, &["batch", "all.json"]), 1);
    assert_eq!(lines(&report).len(), 2);

    // Stopped as the last line was being written: that pair is done again.
    let text = fs::read_to_string(&report).unwrap();
    let cut: Vec<&str> = text.lines().filter(|line| !line.contains("on slim")).collect();
    let half = serde_json::to_string(&first[1]).unwrap();
    fs::write(&report, format!("{}\n{}", cut[0], &half[..half.len() / 2])).unwrap();
    ends(&bespoke(&folder, &["batch", "all.json", "-q"]), 1);
    let whole: Vec<String> = fs::read_to_string(&report).unwrap().lines().map(String::from).collect();
    assert_eq!(whole.len(), 3);
    assert_eq!(serde_json::from_str::<Line>(&whole[2]).unwrap().pair, "vest on slim");
    assert!(fs::read(&result).unwrap() == bytes);

    // So is one whose result is gone, whose options or whose files have changed, and what had none where that is asked for.
    fs::remove_file(&report).unwrap();
    ends(&bespoke(&folder, &["batch", "all.json"]), 1);
    fs::remove_file(&result).unwrap();
    ends(&bespoke(&folder, &["batch", "all.json"]), 1);
    assert_eq!(lines(&report).len(), 3);
    ends(&bespoke(&folder, &["batch", "all.json", "--retry"]), 1);
    assert_eq!(lines(&report).last().unwrap().pair, "vest on broken");
    fs::write(folder.join("broken.glb"), &*AVATAR).unwrap();
    ends(&bespoke(&folder, &["batch", "all.json"]), 0);
    assert_eq!(lines(&report).len(), 5);
    assert!(fs::read(folder.join("results/vest-on-broken.glb")).unwrap() == bytes);
    ends(&bespoke(&folder, &["batch", "all.json"]), 0);
    assert_eq!(lines(&report).len(), 5);
}

#[test]
fn slices_are_a_partition() {
    let folder = folder("slices");
    manifest(
        &folder,
        r#"{"outfits": ["a.glb", "b.glb"], "avatars": ["x.glb", "y.glb", "z.glb"], "output": "{avatar}/{outfit}.glb"}"#,
    );
    let pairs = Manifest::read(&folder.join("all.json")).unwrap().pairs().unwrap();
    assert_eq!(pairs.iter().map(|pair| pair.name.as_str()).collect::<Vec<_>>()[..2], ["a on x", "a on y"]);
    let mut done = Vec::new();
    for part in 1..=4 {
        // None of the files is there, which is told of each pair.
        let slice = format!("{part}/4");
        ends(&bespoke(&folder, &["batch", "all.json", "--slice", &slice, "-q"]), 1);
        done.extend(lines(&folder.join(format!("all.report.{part}of4.jsonl"))).into_iter().map(|line| line.pair));
    }
    let mut all: Vec<String> = pairs.into_iter().map(|pair| pair.name).collect();
    all.sort();
    done.sort();
    assert_eq!(done, all);
}

#[test]
fn a_manifest_that_says_nothing_known_is_refused() {
    let folder = folder("manifests");
    let lists = r#""outfits": ["a.glb"], "avatars": ["b.glb"]"#;
    for (text, said) in [
        ("[]".to_string(), "object"),
        ("{".into(), "JSON"),
        (r#"{"outfits": [], "avatars": ["b.glb"], "output": "{outfit}{avatar}"}"#.into(), "outfits is empty"),
        (r#"{"avatars": ["b.glb"], "output": "{outfit}{avatar}"}"#.into(), "outfits"),
        (format!(r#"{{{lists}, "output": "out.glb"}}"#), "{outfit}"),
        (format!(r#"{{{lists}, "output": "{{outfit}}{{avatar}}", "speed": 3}}"#), "speed"),
        (format!(r#"{{{lists}, "output": "{{outfit}}{{avatar}}", "options": {{"fits": 3}}}}"#), "fits"),
        (r#"{"outfits": [{"nodes": "A"}], "avatars": ["b.glb"], "output": "{outfit}{avatar}"}"#.into(), "entry 1"),
        (
            r#"{"outfits": ["a.glb", "x/a.glb"], "avatars": ["b.glb"], "output": "{outfit}{avatar}"}"#.into(),
            "another name",
        ),
    ] {
        manifest(&folder, &text);
        let run = bespoke(&folder, &["batch", "all.json"]);
        ends(&run, 2);
        let heard = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(heard.contains(said), "{text}: {heard}");
    }
    assert!(!folder.join("all.report.jsonl").exists());
}
