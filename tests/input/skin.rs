//! Skin weights.

use bespoke::error::ErrorKind;
use bespoke::input::skin::SkinWeights;

fn dominant(weights: &SkinWeights) -> Vec<Option<u32>> {
    (0..weights.vertex_count()).map(|v| weights.dominant_joint(v)).collect()
}

#[test]
fn dense_rows() {
    // Three joints, four vertices: clear, a tie, nothing, tiny.
    let weights = [0.2, 0.5, 0.0, 0.0, 0.7, 0.5, 0.0, 1e-300, 0.1, 0.0, 0.0, 0.0];
    let skin = SkinWeights::from_dense(&weights, 3, 4, "skin").unwrap();
    assert_eq!(dominant(&skin), [Some(1), Some(0), None, Some(1)]);
    assert_eq!((skin.joint_count(), skin.vertex_count()), (3, 4));

    let refuse = |weights: &[f64], joints, vertices| {
        let error = SkinWeights::from_dense(weights, joints, vertices, "skin").unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidWeights);
        error.message
    };
    assert_eq!(refuse(&weights, 3, 5), "skin: there are 12 weights, but 3 joints times 5 vertices are needed");
    assert!(refuse(&weights, usize::MAX, 4).contains("are needed"));
    assert_eq!(refuse(&[], 0, usize::MAX / 16), "skin: there are no joints", "and no memory is asked for");
    for (bad, text) in [(-0.5, "-0.5"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let mut weights = weights;
        weights[6] = bad;
        assert_eq!(
            refuse(&weights, 3, 4),
            format!("skin: the weight of vertex 2 for joint 1 is {text}, it must be finite and not negative")
        );
    }
}

#[test]
fn sparse_influences() {
    // Two influences a vertex: clear, a tie with the higher joint first, padding with any joint, a joint twice.
    let joints = [0, 2, 2, 1, 1, 65535, 9, 9, 1, 1];
    let weights = [0.3, 0.7, 0.5, 0.5, 1.0, 0.0, 0.0, 0.0, 0.2, 0.4];
    let skin = SkinWeights::from_sparse(&joints, &weights, 2, 3, 5, "skin").unwrap();
    assert_eq!(dominant(&skin), [Some(2), Some(1), Some(1), None, Some(1)]);
    let twice = SkinWeights::from_sparse(&[2, 0, 2], &[0.3, 0.4, 0.3], 3, 3, 1, "skin").unwrap();
    assert_eq!(dominant(&twice), [Some(2)]);
    let none = SkinWeights::from_sparse(&[], &[], usize::MAX / 16, 3, 0, "skin").unwrap();
    assert_eq!(none.vertex_count(), 0, "influences of no vertex take no memory");

    let refuse = |joints: &[u32], weights: &[f64], influences, vertices| {
        SkinWeights::from_sparse(joints, weights, influences, 3, vertices, "skin").unwrap_err().message
    };
    assert!(refuse(&joints, &weights, 0, 5).contains("influences for each vertex is 0"));
    assert_eq!(
        refuse(&joints[1..], &weights, 2, 5),
        "skin: there are 9 joint indices, but 5 vertices times 2 influences are needed"
    );
    assert!(refuse(&joints, &weights[1..], 2, 5).starts_with("skin: there are 9 weights"));
    assert_eq!(
        refuse(&[0, 3], &[0.5, 0.5], 2, 1),
        "skin: vertex 0 has a weight for joint 3, the skeleton has 3 joints"
    );
    assert!(refuse(&[0, 3], &[0.5, -0.5], 2, 1).contains("vertex 0 for joint 3 is -0.5"));
}

#[test]
fn dense_and_sparse_agree() {
    let mut random = testing::Random::new(3);
    let (joint_count, vertex_count) = (6u32, 50usize);
    // Few distinct values, so that ties and zeros are frequent.
    let by_vertex: Vec<f64> = (0..vertex_count * 6).map(|_| (random.unit() * 4.0).floor() / 4.0).collect();
    let dense: Vec<f64> =
        (0..6).flat_map(|j| (0..vertex_count).map(move |v| v * 6 + j)).map(|i| by_vertex[i]).collect();
    let joints: Vec<u32> = (0..vertex_count).flat_map(|_| (0..joint_count).rev()).collect();
    let sparse: Vec<f64> = by_vertex.chunks(6).flat_map(|row| row.iter().rev().copied()).collect();
    assert_eq!(
        SkinWeights::from_dense(&dense, 6, vertex_count, "a").unwrap(),
        SkinWeights::from_sparse(&joints, &sparse, 6, 6, vertex_count, "b").unwrap()
    );
}
