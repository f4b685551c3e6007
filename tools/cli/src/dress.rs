//! `bespoke dress`: the outfit of one file on the character of another.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::options::Options;
use bespoke::rig::joint_map::{CallersPair, JointMap};
use bespoke::rig::reading::Reading;

use crate::args::Dress;
use crate::attempts::put_on;
use crate::bodies::{self, joined};
use crate::failure::{Failure, Result};
use crate::figure::{Choice, Figure, Part};
use crate::fit::{Fitted, Job, Refused, Skinned};
use crate::joint_pairs;
use crate::known_avatar::KnownAvatar;
use crate::outfit::{self, Garment};
use crate::output;
use crate::parts::Role;
use crate::parts::pattern::Patterns;
use crate::report::{self, DressReport, GarmentLine};
use crate::say::{say, say_findings};

/// Dresses, writes the result and the report. The exit code.
///
/// # Errors
/// Where there is no result; nothing is written then, but the report.
pub fn run(args: &Dress) -> Result<u8> {
    run_on(args, &mut None)
}

/// The same, with the character of the call before, where this one is about the same.
///
/// # Errors
/// As [`run`].
pub fn run_on(args: &Dress, known: &mut Option<KnownAvatar>) -> Result<u8> {
    let patterns = |text: &Option<String>| text.as_deref().map(Patterns::parse).transpose().map_err(Failure::usage);
    let outfit_choice = Choice { garments: patterns(&args.nodes)?, body: None };
    let source_choice = Choice { garments: None, body: patterns(&args.source_nodes)? };
    output::form(&args.output)?;

    let avatar = KnownAvatar::of(args, known)?;
    let outfit = match &args.source {
        Some(_) => Figure::open(&args.outfit, Role::Outfit, &outfit_choice)?,
        None => {
            Figure::open(&args.outfit, Role::Outfit, &Choice { body: source_choice.body.clone(), ..outfit_choice })?
        }
    };
    let source = args.source.as_ref().map(|file| Figure::open(file, Role::Avatar, &source_choice)).transpose()?;
    let made_for = MadeFor::new(&outfit, source.as_ref(), args)?;
    let garments = outfit::in_order(&outfit, outfit::need_garments(&outfit)?, made_for.bodies.first());
    let pairs = match &args.map {
        Some(file) => joint_pairs::read(file, made_for.rig(), &avatar.figure.rig)?,
        None => Vec::new(),
    };
    let dressing = Dressing { args, outfit: &outfit, avatar, made_for: &made_for, pairs: &pairs };
    dressing.run(&garments)
}

/// Whom the outfit was made for.
struct MadeFor<'a> {
    outfit: &'a Figure,
    source: Option<&'a Figure>,
    bodies: Vec<Skinned>,
}

impl<'a> MadeFor<'a> {
    fn new(outfit: &'a Figure, source: Option<&'a Figure>, args: &Dress) -> Result<Self> {
        let bodies = bodies::sources(source.unwrap_or(outfit));
        let made_for = Self { outfit, source, bodies };
        if made_for.rig().joints.is_empty() {
            let file = args.source.as_ref().unwrap_or(&args.outfit);
            return Err(Failure::no_result(format!(
                "{}: it has no skin, so it cannot be known where the body is for which the outfit was made; give the \
                 character that it was made for with --source",
                file.display()
            )));
        }
        Ok(made_for)
    }

    /// The outfit's own joints, or those of the character that it stands on.
    fn rig(&self) -> &'a bespoke::input::rig::Rig {
        match self.source {
            Some(source) if self.outfit.rig.joints.is_empty() => &source.rig,
            _ => &self.outfit.rig,
        }
    }

    /// The bodies on the joints of [`Self::rig`]. Joints of another file correspond by name; a joint that is not there goes with
    /// the one above.
    fn bodies(&self) -> Vec<Skinned> {
        let Some(source) = self.source.filter(|_| !self.outfit.rig.joints.is_empty()) else {
            return self.bodies.clone();
        };
        let there = |body: &Skinned| {
            Some(Skinned {
                skin: joint_pairs::on_rig(&body.skin, &source.rig, &self.outfit.rig)?,
                mesh: body.mesh.clone(),
            })
        };
        self.bodies.iter().filter_map(there).collect()
    }
}

struct Dressing<'a> {
    args: &'a Dress,
    outfit: &'a Figure,
    avatar: &'a KnownAvatar,
    made_for: &'a MadeFor<'a>,
    pairs: &'a [CallersPair],
}

/// A garment with its result.
pub struct Dressed<'a> {
    /// Which parts it is.
    pub garment: &'a Garment,
    /// Its result.
    pub fitted: Fitted,
}

impl Dressing<'_> {
    fn run(&self, garments: &[Garment]) -> Result<u8> {
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
        let sources = self.made_for.bodies();
        let (mut dressed, mut refused) = (Vec::<Dressed>::new(), Vec::new());
        let mut layers: Vec<TriangleMesh> = Vec::new();
        for garment in garments {
            let parts: Vec<&Part> = garment.parts.iter().map(|&part| &self.outfit.parts[part]).collect();
            let (cloth, _) = joined(parts.iter().copied(), self.outfit.rig.joints.len());
            let drawn = outfit::drawn(self.outfit, &parts)?;
            let morphs = outfit::morphs(self.outfit, &parts);
            let job = Job {
                name: &garment.name,
                garment: &cloth,
                drawn: &drawn,
                morphs: &morphs,
                has_skin: !self.outfit.rig.joints.is_empty(),
                source: sources.first(),
                source_rig: self.made_for.rig(),
                avatar: &avatar.body,
                roles: &avatar.roles,
                target_rig: &figure.rig,
                shared,
                layers: &layers,
                pairs: self.pairs,
                influences: args.influences as usize,
                options: &options,
                quiet: args.quiet,
            };
            match put_on(&job, &sources) {
                Ok(fitted) => {
                    say_findings(args.quiet, &garment.name, &fitted.findings, fitted.flaw.is_some());
                    layers.push(TriangleMesh {
                        positions: fitted.positions.clone(),
                        triangles: cloth.mesh.triangles.clone(),
                    });
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
        output::write(args, self.outfit, figure, &dressed)?;
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
        let readings = [Reading::new(source, None), Reading::new(target, None)];
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
