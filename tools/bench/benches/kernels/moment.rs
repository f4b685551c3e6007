//! The moment in a retarget at which kernels are measured.

use std::error::Error;
use std::sync::Arc;

use bespoke::control::Cancel;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::weld::Weld;
use bespoke::memory::MemoryLimit;
use bespoke::options::Options;
use bespoke::sdf::{Field, FieldOptions};
use bespoke::solver::newton::{Model, Newton, State};
use bespoke::stage::fit::FitStage;
use bespoke::stage::inflate::Inflation;
use bespoke::stage::objective::Objective;
use bespoke::stage::setup::problem::{Inputs, Problem};
use glam::DVec3;

use closet::skeleton::BONES;
use closet::{Kind, Sample, sample};

/// Iterations of the fit before it.
const ITERATIONS: u32 = 15;

/// The jacket on the heavy body, half way through the fit.
pub struct Moment {
    pub objective: Objective,
    /// Linearised at `state`.
    pub newton: Newton,
    pub state: State,
    /// The step that would be next.
    pub direction: Vec<DVec3>,
    pub garment: TriangleMesh,
    pub avatar: Arc<TriangleMesh>,
}

impl Moment {
    /// Goes there.
    pub fn new() -> Result<Self, Box<dyn Error>> {
        let (jacket, body) = (sample(Kind::Jacket), sample(Kind::Heavy));
        let weld = Weld::new(&mesh(&jacket)).0;
        let mut fit_weights = vec![1.0; weld.mesh.positions.len()];
        jacket.no_fit.iter().for_each(|&v| fit_weights[weld.to_welded[v as usize] as usize] = 0.0);
        let options = Options::default();
        let inputs = Inputs {
            garment: &weld.mesh,
            weld: Arc::new(weld.clone()),
            source_skeleton: &skeleton(&jacket),
            avatar: &mesh(&body).into(),
            target_skeleton: &skeleton(&body),
            skin: None,
            ends: [None, None],
            source_avatar: None,
            fit_weights: Some(&fit_weights),
            pins: &[],
            rigid_groups: &[],
            curves: &[],
            offset: 0.0,
            coordinate_error: 0.0,
            turns: true,
            known: Arc::default(),
        };
        let problem = Problem::new(&inputs, &options, &Cancel::new(), &mut Vec::new())?;
        let mut objective = problem.inflation_objective(&options, &Cancel::new(), &mut Vec::new())?;
        let mut state = State { x: problem.rest.clone(), t: 0.0 };
        let mut newton = Newton::new(state.x.len(), &objective.terms(), MemoryLimit::NONE, Cancel::new())?;
        let mut inflation = Inflation::default();
        while !inflation.iterate(&mut objective, &mut newton, &mut state)? {
            if inflation.iterations >= options.max_iterations {
                return Err("the inflation does not end".into());
            }
        }
        let field =
            Field::build(&problem.avatar, FieldOptions { voxel: options.voxel_size, threads: 1 }, &Cancel::new())?;
        let mut next = problem.fit_objective(Arc::new(field), &state.x, &options, &Cancel::new())?;
        next.contact.inherit_state(&objective.contact);
        objective = next;
        newton = Newton::new(state.x.len(), &objective.terms(), MemoryLimit::NONE, Cancel::new())?;
        let mut settling = FitStage::begin(&mut objective, &state, &options);
        for _ in 0..ITERATIONS {
            settling.iterate(&mut objective, &mut newton, &mut state, &options)?;
        }
        newton.linearise(&objective.terms(), state.configuration(), false)?;
        newton.set_direction(0.0);
        let direction = newton.direction().to_vec();
        let garment = TriangleMesh { positions: state.x.clone(), triangles: problem.triangles.clone() };
        Ok(Self { objective, newton, state, direction, garment, avatar: problem.avatar })
    }
}

fn mesh(sample: &Sample) -> TriangleMesh {
    TriangleMesh { positions: sample.mesh.positions.clone(), triangles: sample.mesh.triangles.clone() }
}

fn skeleton(sample: &Sample) -> Skeleton {
    Skeleton { joints: sample.skeleton.joints.to_vec(), bones: BONES.to_vec() }
}
