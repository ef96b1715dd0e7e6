//! The stages, with a cache for what each of them made: what is asked for again is not made again.
//! The command line runs an engine once; the studio keeps one and changes a little at a time.

use super::bodies::Decisive;
use super::concave::{self, Refitted};
use super::judge::FoldJudge;
use super::mend::{Maker, Mended, mended, unmended};
use super::merge::{self, Merge};
use super::plugs::{self, Planned};
use super::segmented::Segmented;
use super::warning::{self, not_joined};
use super::{Bodies, Divided, Error, MeshParts, Options, Output, Shaped, Source, Warning};
use glam::DAffine3;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tatamu_core::cache::LruCache;
use tatamu_core::design::{ThickError, thick};
use tatamu_core::fold::{Detection, FoldPlan, ModelMotion, SweepCache};
use tatamu_core::mesh::{Mesh, Up};
use tatamu_core::model::{
    self, Alike, Built, JointChoice, Known, Model, ModelError, ModelPart, PartId, Run, Sketch,
};
use tatamu_core::progress::{Beside, Cancelled, Progress};
use tatamu_core::segment::{Edit, Parts, SegmentOptions};
use tatamu_net::net::{BlankNet, KnownNets, Net, NetChoices, NetHand, NetOptions, develop_model};
use tatamu_net::sheet::{Layout, Pin, SheetOptions};

/// Number of results that each whole stage keeps, for going back and forth between a few choices.
const FEW: usize = 4;

/// All stages for one mesh.
///
/// # Guarantees
/// A result depends on the mesh and the options alone, not on what was asked for before.
#[derive(Debug)]
pub struct Engine<'m> {
    mesh: Cow<'m, Mesh>,
    segmented: LruCache<PartsKey, Arc<Segmented>>,
    divided: LruCache<DividedKey, Arc<Divided>>,
    components: Known,
    /// What is known of motions, until it is forgotten.
    sweeps: Mutex<Arc<SweepCache>>,
    /// What the parts of the models of last time are known by in `sweeps`.
    alike: LruCache<Arc<Model>, Alike>,
    plans: LruCache<PlanKey, Planned>,
    nets: KnownNets,
    layouts: LruCache<LayoutKey, (Arc<Layout>, Arc<Vec<Net>>)>,
}

/// What decides a layout: sheets, pins, colours of card, and the nets with their alternatives.
type LayoutKey = (SheetOptions, BTreeMap<String, Pin>, Vec<Option<String>>, Arc<Vec<Vec<Arc<BlankNet>>>>);

/// What decides a plan: the model, the thickness, the width of tabs, which plugs keep off, and the
/// components that must stay glued.
type PlanKey = (Arc<Model>, f64, f64, Vec<bool>);

/// What decides the parts before they are changed by hand, whatever the size of the model: axis and segmentation.
type PartsKey = (Up, SegmentOptions);

/// What decides the hulls: the parts, the model's size, mm, changes by hand, and the root.
type DividedKey = (PartsKey, f64, Vec<Edit>, Option<String>);

impl<'m> Engine<'m> {
    /// An engine for a mesh as it was read.
    pub fn new(mesh: Cow<'m, Mesh>) -> Self {
        Self {
            mesh,
            segmented: LruCache::new(FEW),
            divided: LruCache::new(FEW),
            components: Known::default(),
            sweeps: Mutex::default(),
            alike: LruCache::new(FEW),
            plans: LruCache::new(FEW),
            nets: KnownNets::default(),
            layouts: LruCache::new(FEW),
        }
    }

    /// The mesh as it was read.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Forgets what is known of motions where that is more than `most` answers. Results stay the same; the next one
    /// takes longer.
    pub fn forget_motions(&self, most: usize) {
        let mut sweeps = self.sweeps();
        if sweeps.len() > most {
            *sweeps = Arc::default();
        }
    }

    fn sweeps(&self) -> MutexGuard<'_, Arc<SweepCache>> {
        self.sweeps.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs all stages.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn run(&self, options: &Options, progress: &dyn Progress) -> Result<Output, Error> {
        self.finish(self.shape(options, progress)?, progress)
    }

    /// The mesh at the size of the options, its parts and their hulls.
    ///
    /// # Errors
    /// [`Error::Segment`], [`Error::Edit`], [`Error::NothingSolid`], [`Error::Cancelled`].
    pub fn divide(&self, options: &Options, progress: &dyn Progress) -> Result<Arc<Divided>, Error> {
        let found = (options.up, options.segmentation);
        self.divided.get_or((found, options.size_mm, options.edits.clone(), options.root.clone()), || {
            let Segmented { parts, to_model, touching } = self.segmented(options, progress)?;
            progress.stage("hulls");
            let divided = Divided::new(&parts, to_model, touching)?;
            progress.check()?;
            Ok(Arc::new(divided))
        })
    }

    /// Divides the mesh at the model's size into parts; also gives the transform from the
    /// coordinates of the mesh as it was read.
    ///
    /// # Errors
    /// [`Error::Segment`], [`Error::Edit`], [`Error::Cancelled`].
    pub fn find_parts(&self, options: &Options, progress: &dyn Progress) -> Result<(Parts, DAffine3), Error> {
        let Segmented { parts, to_model, .. } = self.segmented(options, progress)?;
        Ok((parts, to_model))
    }

    /// The parts after they are changed by hand.
    fn segmented(&self, options: &Options, progress: &dyn Progress) -> Result<Segmented, Error> {
        let segmented = self.segmented.get_or((options.up, options.segmentation), || {
            Segmented::of_mesh(&self.mesh, options.up, &options.segmentation, progress).map(Arc::new)
        })?;
        Ok(segmented.at_size(options.size_mm).edited(&options.edits, options.root.as_deref())?)
    }

    /// Makes the components.
    ///
    /// # Errors
    /// As [`Engine::divide`], and [`Error::Model`], [`Error::NoComponent`], [`Error::SameName`],
    /// [`Error::NoPlug`].
    pub fn shape(&self, options: &Options, progress: &dyn Progress) -> Result<Shaped, Error> {
        let (designed, factor) = options.designed();
        let maker = Making { engine: self, options: &designed, sketches: LruCache::new(SKETCHES), progress };
        let Mended { divided, built, merges, .. } =
            if options.is_tiny() { unmended(&maker)? } else { mended(&maker)? };
        self.know(&built);
        let source = divided.resized(factor);
        let mut found = refitted(resized(built.model, factor), &source, options, progress)?;
        for name in found.refused.clone() {
            if options.components.get(&name).is_some_and(|own| own.direction_rad.is_none())
                && let Some(other) = self.dented((&divided, &source), options, &name, progress)?
            {
                found = other;
            }
        }
        let Refitted { model, warnings: mut notes, mut remarks, .. } = found;
        notes.extend(not_joined(&model).map(Warning::from));
        let glued = Arc::new(model);
        let model = Arc::new(plugs::as_chosen(Model::clone(&glued), options)?);
        if let Some(alike) = self.alike.get(&glued) {
            // How parts are held changes nothing about how they fold.
            self.alike.keep(model.clone(), alike);
        }
        let source = Source::Mesh(Arc::new(source));
        remarks.extend(merges.iter().map(merge::remark));
        Ok(Shaped { options: Arc::new(options.clone()), source, model, notes, remarks, merges })
    }

    /// Components are built of parts, all of them convex. `detection` finds where they clash.
    fn building<T>(
        &self,
        divided: &Divided,
        options: &Options,
        (detection, progress): (Detection, &dyn Progress),
        build: impl FnOnce(Run<'_>) -> Result<T, ModelError>,
    ) -> Result<T, Error> {
        let bodies = Bodies::new(divided.hulls(), options)?;
        let assembly = bodies.assembly(options.min_panel_width_mm);
        let sweeps = self.sweeps().clone();
        let judge = FoldJudge { thickness_mm: options.thickness_mm, detection, cache: &sweeps, progress };
        let (known, firmness) = (&self.components, divided.hulls().firmness());
        Ok(build(Run { assembly: &assembly, known, firmness, judge: &judge, progress })?)
    }

    /// Remembers what the parts of a model are known by, for its folding.
    fn know(&self, built: &Built) {
        self.alike.keep(Arc::new(built.model.clone()), built.alike.clone());
    }

    /// The components in the first direction of one of them in which it has dents; none where it has them
    /// in no direction. Directions are chosen for convex shapes, and a dent need not fold in these.
    fn dented(
        &self,
        (divided, source): (&Divided, &MeshParts),
        options: &Options,
        name: &String,
        progress: &dyn Progress,
    ) -> Result<Option<Refitted>, Error> {
        for direction_rad in concave::directions_rad() {
            let mut options = options.clone();
            if let Some(own) = options.components.get_mut(name) {
                own.direction_rad = Some(direction_rad);
            }
            let (designed, factor) = options.designed();
            let how = (Detection::Discrete, progress);
            let built = self.building(divided, &designed, how, |run| run.finished(&run.sketch(None)?));
            if let Ok(built) = &built {
                self.know(built);
            }
            match built.and_then(|built| refitted(resized(built.model, factor), source, &options, progress)) {
                Ok(found) if !found.refused.contains(name) => return Ok(Some(found)),
                // Not every direction has room for all joints.
                Ok(_) | Err(Error::Model(_)) => progress.check()?,
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }

    /// Makes one component, by its id, as it and its joints alone decide it, and where the mesh has it, not yet
    /// moved onto its parent: sooner than the model that looks and folds best.
    ///
    /// # Errors
    /// As [`Engine::shape`]; [`Error::NoComponent`] where there is no component with this id.
    pub fn component(
        &self,
        options: &Options,
        part: PartId,
        progress: &dyn Progress,
    ) -> Result<ModelPart, Error> {
        let (designed, factor) = options.designed();
        let divided = self.divide(&designed, progress)?;
        let bodies = Bodies::new(divided.hulls(), &designed)?;
        if part.0 >= bodies.parts().len() {
            let known = divided.hulls().names().join(", ");
            return Err(Error::NoComponent { name: format!("number {}", part.0 + 1), known });
        }
        progress.check()?;
        let made = model::alone(&bodies.assembly(designed.min_panel_width_mm), &self.components, part)?;
        Ok(made.resized(factor))
    }

    /// Whether components fold without a clash, some of them plugged if need be.
    ///
    /// # Errors
    /// [`Cancelled`] at the user's wish.
    pub fn folds_freely(&self, shaped: &Shaped, progress: &dyn Progress) -> Result<bool, Cancelled> {
        Ok(self.plan(&shaped.model, &shaped.options, progress)?.plan.is_free())
    }

    /// How the components fold; some of them are plugged, where nothing else is free.
    pub(super) fn plan(
        &self,
        model: &Arc<Model>,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Planned, Cancelled> {
        self.plans.get_or(plan_key(model, options), || {
            progress.stage("folding");
            // Of models that were changed since they were built nothing is known.
            let (alike, cache) = match self.alike.get(model) {
                Some(alike) => (alike, self.sweeps().clone()),
                None => (Alike::unknown(model.parts().len()), Arc::default()),
            };
            let motion = ModelMotion::new(model);
            let plan = FoldPlan::with_cache(&motion, options.thickness_mm, &alike, &cache, progress)?;
            let planned = Planned { model: model.clone(), plan: Arc::new(plan) };
            let known = plugs::Known { ids: &alike.ids, cache: &cache };
            Ok(plugs::freed(&planned, &known, options, progress)?.unwrap_or(planned))
        })
    }

    /// From the components to sheets, with the order of folding, which is looked for meanwhile: as
    /// a stage it is only what is left of that when the sheets are done.
    ///
    /// # Errors
    /// [`Error::Thick`], [`Error::Net`], [`Error::Layout`], [`Error::Cancelled`].
    pub fn finish(&self, shaped: Shaped, progress: &dyn Progress) -> Result<Output, Error> {
        let shaped = of_boards(shaped)?;
        let (model, options) = (shaped.model.clone(), shaped.options.clone());
        let is_known = self.plans.get(&plan_key(&model, &options)).is_some();
        let beside = Beside::new(progress);
        let lay_out = || {
            let laid = self.lay_out_paper(shaped, progress);
            if laid.is_err() {
                beside.give_up();
            } else if !is_known {
                progress.stage("folding");
            }
            laid
        };
        let (laid, planned) = rayon::join(lay_out, || self.plan(&model, &options, &beside));
        self.with_plan(laid?, planned?, progress)
    }

    /// With a plan, and laid out again where that needs other pieces.
    fn with_plan(&self, laid: Output, planned: Planned, progress: &dyn Progress) -> Result<Output, Error> {
        if planned.model == laid.shaped.model {
            return Ok(laid.with_plan(planned.plan));
        }
        let mut shaped = laid.shaped;
        shaped.remarks.extend(plugs::remarks(&shaped.model, &planned.model));
        shaped.model = planned.model;
        Ok(self.lay_out_paper(shaped, progress)?.with_plan(planned.plan))
    }

    /// From the components to sheets; in which order they fold is not known yet.
    ///
    /// # Errors
    /// [`Error::Thick`], [`Error::Net`], [`Error::Layout`], [`Error::Cancelled`].
    pub fn lay_out(&self, shaped: Shaped, progress: &dyn Progress) -> Result<Output, Error> {
        self.lay_out_paper(of_boards(shaped)?, progress)
    }

    fn lay_out_paper(&self, shaped: Shaped, progress: &dyn Progress) -> Result<Output, Error> {
        let (options, model) = (&*shaped.options, &shaped.model);
        let sheets = SheetOptions {
            paper: options.paper,
            margin_mm: options.margin_mm,
            choices: options.sheets,
            has_valleys: model.has_valleys(),
        };
        let net_options = NetOptions {
            tab_width_mm: options.tab_width_mm,
            sheet_mm: sheets.room_mm(),
            choices: NetChoices { is_separate: options.is_thick, ..options.nets },
            hand: NetHand::default(),
        };
        let names = || model.parts().iter().map(|part| &part.name);
        if let Some(name) = options.hands.keys().find(|name| names().all(|known| known != *name)) {
            let known = names().cloned().collect::<Vec<_>>().join(", ");
            return Err(Error::NoComponent { name: name.clone(), known });
        }
        progress.stage("nets");
        let alternatives = develop_model(model, &net_options, &options.hands, &self.nets, progress)
            .map_err(|error| Error::Net { error, size_mm: options.size_mm, margin_mm: options.margin_mm })?;
        let alternatives = Arc::new(alternatives);
        let cards: Vec<Option<String>> =
            model.parts().iter().map(|part| options.card(&part.name).cloned()).collect();
        let key = (sheets, options.pins.clone(), cards.clone(), alternatives.clone());
        let (layout, nets) = self.layouts.get_or(key, || {
            progress.stage("sheets");
            let laid = Layout::of_alternatives(&alternatives, &cards, &sheets, &options.pins, progress)?;
            Ok::<_, Error>((Arc::new(laid.0), Arc::new(laid.1)))
        })?;
        let mut warnings = shaped.notes.clone();
        warnings.extend(warning::warnings(model, &nets, shaped.source.parts(), options));
        warnings.extend(warning::many_sheets(&layout).map(Warning::from));
        warnings.extend(layout.pin_warnings().iter().cloned().map(Warning::from));
        let fold_plan = Arc::new(FoldPlan::unchecked(model, options.thickness_mm));
        Ok(Output { shaped, fold_plan, nets, layout, warnings: Arc::new(warnings) })
    }

    /// Finds the order of folding.
    ///
    /// # Errors
    /// [`Error::Cancelled`]; where plugs change pieces, those of [`Engine::lay_out`], too.
    pub fn fold(&self, laid: Output, progress: &dyn Progress) -> Result<Output, Error> {
        let planned = self.plan(&laid.shaped.model, laid.options(), progress)?;
        self.with_plan(laid, planned, progress)
    }
}

/// The components, with dents where they may have them.
fn refitted(
    model: Model,
    source: &MeshParts,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Refitted, Error> {
    Ok(concave::refitted(model, source.mesh(), source.face_parts(), options, progress)?)
}

/// The model with all lengths times `factor`; the same one where that is 1, as its motions are known.
fn resized(model: Model, factor: f64) -> Model {
    if factor == 1.0 { model } else { model.resized(factor) }
}

fn plan_key(model: &Arc<Model>, options: &Options) -> PlanKey {
    let is_glued = |part: &ModelPart| options.joint_choice(&part.name) == Some(JointChoice::Glue);
    let must_be_glued = model.parts().iter().map(|part| options.is_thick || is_glued(part)).collect();
    (model.clone(), options.thickness_mm, options.tab_width_mm, must_be_glued)
}

/// Of boards as thick as they are, where that was asked for.
fn of_boards(shaped: Shaped) -> Result<Shaped, Error> {
    let options = &*shaped.options;
    if !options.is_thick {
        return Ok(shaped);
    }
    let is_mesh = matches!(shaped.source, Source::Mesh(_));
    let (boards, thick) = thick(&shaped.model, options.thickness_mm, options.min_panel_width_mm).map_err(
        // That of missing room says what boards suit.
        |error| match error {
            error if is_mesh && !matches!(error, ThickError::NoRoom { .. }) => Error::ThickMesh(error),
            error => Error::Thick(error),
        },
    )?;
    let mut notes = shaped.notes.clone();
    notes.extend(thick.into_iter().map(Warning::from));
    Ok(Shaped { model: Arc::new(boards), notes, ..shaped })
}

/// Number of sketches that are kept, for joints that are tried again after others. A chair asks for 23.
const SKETCHES: usize = 100;

/// Models with one set of options.
struct Making<'m> {
    engine: &'m Engine<'m>,
    options: &'m Options,
    sketches: LruCache<Decisive, Arc<Sketch>>,
    progress: &'m dyn Progress,
}

impl Maker for Making<'_> {
    fn divided(&self, merges: &[Merge]) -> Result<Arc<Divided>, Error> {
        let mut options = self.options.clone();
        options.edits.extend(merges.iter().map(|parts| Edit::Merge { parts: parts.clone() }));
        let divided = self.engine.divide(&options, self.progress)?;
        self.progress.stage("components");
        Ok(divided)
    }

    fn may_vanish(&self, part: &str) -> bool {
        !self.options.speaks_of(part)
    }

    fn sketch(&self, divided: &Divided, like: Option<&Model>) -> Result<Arc<Sketch>, Error> {
        let Self { engine, options, ref sketches, progress } = *self;
        sketches.get_or(divided.hulls().decisive(), || {
            let how = (Detection::Discrete, progress);
            engine.building(divided, options, how, |run| run.sketch(like).map(Arc::new))
        })
    }

    fn finish(&self, divided: &Divided, sketch: &Sketch) -> Result<(Built, f64), Error> {
        let (built, harm_mm) = self.planned(divided, Detection::Discrete, |run| run.finished(sketch))?;
        if harm_mm == 0.0 || !built.verdict.is_clean() {
            return Ok((built, harm_mm));
        }
        // Discrete detection missed a clash: the nose of a snowman of 80 mm passes its hat between two samples.
        let like = Some(&built.model);
        let closer = self.planned(divided, Detection::Continuous, |run| run.finished(&run.sketch(like)?))?;
        Ok(if closer.1 < harm_mm { closer } else { (built, harm_mm) })
    }
}

impl Making<'_> {
    /// A model, and what is wrong with it once its folding is planned, mm.
    fn planned(
        &self,
        divided: &Divided,
        detection: Detection,
        build: impl FnOnce(Run<'_>) -> Result<Built, ModelError>,
    ) -> Result<(Built, f64), Error> {
        let Self { engine, options, progress, .. } = *self;
        let built = engine.building(divided, options, (detection, progress), build)?;
        engine.know(&built);
        // Some that clash at first sight have a way past each other, or a plug.
        let planned = engine.plan(&Arc::new(built.model.clone()), options, progress)?;
        let harm_mm = planned.model.harm_mm(&planned.plan.bumps());
        Ok((built, harm_mm))
    }
}
