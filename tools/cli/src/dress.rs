//! `bespoke dress`: the outfit of one file on the character of another.

use std::path::PathBuf;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::options::Options;
use bespoke::rig::joint_map::{CallersPair, JointMap};

use crate::args::{Dress, ObjFiles};
use crate::attempts::put_on;
use crate::bodies::{self, joined};
use crate::failure::{Failure, Result};
use crate::figure::{Choice, Figure, Part};
use crate::fit::{Fitted, Job, Refused, Skinned, shared_garment};
use crate::joint_pairs;
use crate::known_avatar::KnownAvatar;
use crate::known_outfits::{KnownOutfit, KnownOutfits};
use crate::obj::{self, Beside};
use crate::outfit::{self, Garment};
use crate::output::{self, Written};
use crate::parts::Role;
use crate::parts::pattern::Patterns;
use crate::report::{self, DressReport, GarmentLine};
use crate::say::{say, say_findings};

/// Dresses, writes the result and the report. The exit code.
///
/// # Errors
/// Where there is no result; nothing is written then, but the report.
pub fn run(args: &Dress) -> Result<u8> {
    run_with(args, &mut Known::default())
}

/// What is known from calls before.
#[derive(Default)]
pub struct Known {
    avatar: Option<KnownAvatar>,
    outfits: KnownOutfits,
}

/// The same, with what is known of the same character and the same outfit.
///
/// # Errors
/// As [`run`].
pub fn run_with(args: &Dress, known: &mut Known) -> Result<u8> {
    let patterns = |text: &Option<String>| text.as_deref().map(Patterns::parse).transpose().map_err(Failure::usage);
    let outfit_choice = Choice { garments: patterns(&args.nodes)?, body: None };
    let source_choice = Choice { garments: None, body: patterns(&args.source_nodes)? };
    let written = output::written(args)?;

    let avatar = KnownAvatar::of(args, &mut known.avatar)?;
    output::need_weights(written, args, &avatar.figure)?;
    let beside = Files::new(args)?;
    let outfit_choice = match &args.source {
        Some(_) => outfit_choice,
        None => Choice { body: source_choice.body.clone(), ..outfit_choice },
    };
    let outfit = Figure::open_with(&args.outfit, Role::Outfit, &outfit_choice, &beside.outfit)?;
    let open_source = |file| Figure::open_with(file, Role::Avatar, &source_choice, &beside.source);
    let source = args.source.as_deref().map(open_source).transpose()?;
    let made_for = MadeFor::new(&outfit, source.as_ref(), args)?;
    let garments = outfit::in_order(&outfit, outfit::need_garments(&outfit)?, made_for.body.as_ref());
    // Joint by joint, where two skeletons without names have the same joints and bones.
    let skeletons = made_for.skeleton().zip(avatar.figure.skeleton());
    let skeletons = skeletons.filter(|(source, target)| target.aligned_to(source).is_ok());
    let pairs = match (&args.map, skeletons) {
        (Some(file), _) => joint_pairs::read(file, made_for.rig(), &avatar.figure.rig)?,
        (None, Some((source, _))) => (0..source.joints.len() as u32).map(|joint| (joint, Some(joint))).collect(),
        (None, None) => Vec::new(),
    };
    // What is mended by hand, or says where the garment hangs, is told of rigs.
    let is_plain = args.map.is_none() && !outfit.has_skin();
    let skeletons = skeletons.filter(|_| is_plain).map(|(source, target)| [source, target]);
    let dressing = Dressing { args, written, outfit: &outfit, avatar, made_for: &made_for, pairs: &pairs, skeletons };
    dressing.run(&garments, known.outfits.of(args))
}

/// What is given beside OBJ files of outfit and source.
struct Files {
    outfit: Beside,
    source: Beside,
}

impl Files {
    fn new(args: &Dress) -> Result<Self> {
        let ObjFiles { source_skeleton, source_skin, garment_skin, source_space, .. } = &args.obj;
        if args.source.is_none() && source_skin.is_some() {
            return Err(Failure::usage("--source-skin is for the character that --source names"));
        }
        let source_is_obj = args.source.as_deref().is_some_and(obj::is_obj);
        let beside = |is_meant: bool, skin: &Option<PathBuf>| Beside {
            skeleton: source_skeleton.clone().filter(|_| is_meant),
            space: source_space.clone().filter(|_| is_meant),
            skin: skin.clone(),
        };
        // Where neither is an OBJ file, the outfit's refuses them.
        let outfit_is_meant = obj::is_obj(&args.outfit) || !source_is_obj;
        Ok(Self { outfit: beside(outfit_is_meant, garment_skin), source: beside(source_is_obj, source_skin) })
    }
}

/// Whom the outfit was made for.
struct MadeFor<'a> {
    outfit: &'a Figure,
    source: Option<&'a Figure>,
    body: Option<Skinned>,
}

impl<'a> MadeFor<'a> {
    fn new(outfit: &'a Figure, source: Option<&'a Figure>, args: &Dress) -> Result<Self> {
        let body = bodies::source(source.unwrap_or(outfit));
        let made_for = Self { outfit, source, body };
        if made_for.rig().joints.is_empty() {
            let file = args.source.as_ref().unwrap_or(&args.outfit);
            if obj::is_obj(file) {
                return Err(Failure::no_result(format!(
                    "{}: there is no skeleton beside it, so it cannot be known where the body is for which the outfit was \
                     made; name it with --source-skeleton (an OBJ file with a v line for each joint and an l line for each \
                     bone), or put it there as skeleton.obj",
                    file.display()
                )));
            }
            return Err(Failure::no_result(format!(
                "{}: it has no skin, so it cannot be known where the body is for which the outfit was made; give the \
                 character that it was made for with --source",
                file.display()
            )));
        }
        Ok(made_for)
    }

    /// Whose joints count: the outfit's, or those of the character that it stands on, where it has none or hangs on none.
    fn joints_of(&self) -> &'a Figure {
        match self.source {
            Some(source) if !self.outfit.has_skin() && !source.rig.joints.is_empty() => source,
            _ => self.outfit,
        }
    }

    fn rig(&self) -> &'a bespoke::input::rig::Rig {
        &self.joints_of().rig
    }

    fn skeleton(&self) -> Option<&'a Skeleton> {
        self.joints_of().skeleton()
    }

    /// The body on the joints of [`Self::rig`]. Joints of another file correspond by name; a joint that is not there goes with
    /// the one above.
    fn body(&self) -> Option<Skinned> {
        let body = self.body.clone()?;
        let Some(source) = self.source.filter(|_| std::ptr::eq(self.joints_of(), self.outfit)) else {
            return Some(body);
        };
        let is_of_one = source.skeleton().is_some() && source.skeleton() == self.outfit.skeleton();
        if is_of_one || !body.has_weights() {
            return Some(body);
        }
        Some(Skinned { skin: joint_pairs::on_rig(&body.skin, &source.rig, &self.outfit.rig)?, mesh: body.mesh })
    }
}

struct Dressing<'a> {
    args: &'a Dress,
    written: Written,
    outfit: &'a Figure,
    avatar: &'a KnownAvatar,
    made_for: &'a MadeFor<'a>,
    pairs: &'a [CallersPair],
    skeletons: Option<[&'a Skeleton; 2]>,
}

/// A garment with its result.
pub struct Dressed<'a> {
    /// Which parts it is.
    pub garment: &'a Garment,
    /// Its result.
    pub fitted: Fitted,
}

impl Dressing<'_> {
    fn run(&self, garments: &[Garment], known: &mut KnownOutfit) -> Result<u8> {
        let args = self.args;
        let options = Options {
            threads: args.threads,
            fit_weight: args.fit,
            offset: args.offset,
            designed_clearance: args.looseness,
            ..Options::default()
        };
        let KnownAvatar { figure, body: avatar, shared, .. } = self.avatar;
        let notes = self.outfit.notes.iter().chain(&figure.notes).chain(&avatar.notes);
        notes.for_each(|note| say(args.quiet, note));
        if self.written != Written::Obj {
            let files = [self.outfit, figure].into_iter().filter_map(|figure| figure.obj.as_ref());
            files.flat_map(|source| &source.material_notes).for_each(|note| say(args.quiet, note));
        }
        let source = self.made_for.body();
        let (mut dressed, mut refused) = (Vec::<Dressed>::new(), Vec::new());
        let mut layers: Vec<TriangleMesh> = Vec::new();
        for garment in garments {
            let parts: Vec<&Part> = garment.parts.iter().map(|&part| &self.outfit.parts[part]).collect();
            let (cloth, _) = joined(parts.iter().copied(), self.outfit.rig.joints.len());
            let drawn = outfit::drawn(self.outfit, &parts)?;
            let morphs = outfit::morphs(self.outfit, &parts);
            let (has_skin, rig, space) = (self.outfit.has_skin(), self.made_for.rig(), self.outfit.space());
            let make = || shared_garment(&cloth, has_skin, &morphs, source.as_ref(), rig, space);
            let shared_garment = match known.garment(&garment.parts, &cloth.mesh, make) {
                Ok(shared) => shared,
                Err(error) => {
                    let failure = Failure::no_result(format!("{}: {error}", garment.name));
                    refused.push((garment, Box::new(Refused { failure, findings: Vec::new(), held_by: None })));
                    continue;
                }
            };
            let job = Job {
                name: &garment.name,
                garment: &cloth,
                drawn: &drawn,
                morphs: &morphs,
                has_skin,
                source: source.as_ref(),
                source_rig: rig,
                avatar: &avatar.body,
                roles: &avatar.roles,
                target_rig: &figure.rig,
                shared_garment: &shared_garment,
                shared_avatar: shared,
                dispensable: &[],
                layers: &layers,
                pairs: self.pairs,
                skeletons: self.skeletons,
                space: self.avatar.space,
                influences: args.influences as usize,
                options: &options,
                quiet: args.quiet,
            };
            match put_on(&job) {
                Ok(fitted) => {
                    say_findings(args.quiet, &garment.name, &fitted.findings, fitted.flaw.is_some());
                    // What is not where it is worn, as a shoe beside its foot, would lead the next garments astray.
                    if !fitted.is_astray {
                        layers.push(TriangleMesh {
                            positions: fitted.positions.clone(),
                            triangles: cloth.mesh.triangles.clone(),
                        });
                    }
                    dressed.push(Dressed { garment, fitted });
                }
                Err(why) => {
                    say_findings(args.quiet, &garment.name, &why.findings, true);
                    if why.failure == Failure::interrupted() {
                        return Err(why.failure);
                    }
                    refused.push((garment, why));
                }
            }
        }
        if let Some(file) = &args.json {
            report::write(file, &self.report(&dressed, &refused, &avatar.notes)?)?;
        }
        if let Some((_, why)) = refused.first() {
            let mut sentence = why.failure.sentence.clone();
            for (_, why) in &refused[1..] {
                sentence = format!("{sentence}\n{}", why.failure.sentence);
            }
            let choices: Vec<String> = refused.iter().map(|(garment, _)| format!("!{}", garment.node)).collect();
            return Err(Failure::no_result(format!(
                "{sentence}\nnothing was written; --nodes '{}' leaves {} out",
                choices.join(","),
                if refused.len() == 1 { "it" } else { "these" }
            )));
        }
        report::in_folder(&args.output)
            .map_err(|e| Failure::no_result(format!("{}: its folder cannot be made: {e}", args.output.display())))?;
        match self.written {
            Written::Gltf(form) => output::write(args, form, self.outfit, figure, &dressed)?,
            Written::Obj => obj::write(args, self.outfit, figure, &dressed)?,
        }
        let flaws: Vec<_> = dressed.iter().filter_map(|d| Some((d.garment, d.fitted.flaw.as_ref()?))).collect();
        flaws.iter().for_each(|(garment, flaw)| say(false, &format!("{}: {flaw}", garment.name)));
        Ok(if flaws.is_empty() { 0 } else { 3 })
    }

    fn report(
        &self,
        dressed: &[Dressed],
        refused: &[(&Garment, Box<Refused>)],
        notes: &[String],
    ) -> Result<DressReport> {
        let (source, target) = (self.made_for.rig(), &self.avatar.figure.rig);
        let readings = [self.made_for.joints_of().reading(), self.avatar.figure.reading()];
        let map = JointMap::new(source, target, readings, self.pairs).map_err(|e| Failure::no_result(e.message))?;
        let done = dressed.iter().map(|d| GarmentLine::dressed(&d.garment.name, &d.fitted));
        let not = refused.iter().map(|(g, why)| GarmentLine::refused(&g.name, &why.failure, &why.findings));
        Ok(DressReport {
            outfit: self.args.outfit.display().to_string(),
            avatar: self.args.avatar.display().to_string(),
            output: refused.is_empty().then(|| self.args.output.display().to_string()),
            garments: done.chain(not).collect(),
            notes: self.outfit.notes.iter().chain(&self.avatar.figure.notes).chain(notes).cloned().collect(),
            joint_map: report::joint_map(&map, source, target),
        })
    }
}
