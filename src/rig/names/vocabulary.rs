//! What words mean in the names of joints, whichever tool wrote them. To teach the reader a word, add it to its row.

use std::collections::HashMap;

use super::super::body_part::Finger;
use super::slot::Slot;
use super::tokens::is_number;

/// Words that stand for a part, with how surely they do. Where one stands for several, the chain that its joint is in
/// decides: collar, shoulder, elbow is one arm, shoulder, arm, forearm another.
const PARTS: &[(&str, &[(Slot, f64)])] = &[
    (
        "hips hip pelvis becken hüfte huefte bassin cadera bacino quadril таз 骨盆 下半身 lowerbody lowertorso",
        &[(Slot::Hips, 1.0)],
    ),
    (
        "spine chest upperchest lowerchest torso uppertorso abdomen waist back lowerback upperback thorax ribs ribcage trunk \
         upperbody stomach belly wirbelsäule wirbelsaeule brust colonne poitrine columna pecho colonna petto coluna peito позвоночник \
         грудь 脊柱 脊椎 上半身 spinelower spineupper \
         lowerspine upperspine abdomenlower abdomenupper chestlower chestupper",
        &[(Slot::Spine, 1.0)],
    ),
    (
        "neck hals cou cuello collo pescoço pescoco шея 首 脖子 颈 necklower neckupper lowerneck upperneck",
        &[(Slot::Neck, 1.0)],
    ),
    ("head kopf skull cranium tête tete cabeza testa cabeça cabeca голова 頭 头 头部", &[(Slot::Head, 1.0)]),
    ("jaw lowerjaw jawlower kiefer unterkiefer", &[(Slot::Jaw, 1.0)]),
    ("eye eyeball auge 目", &[(Slot::Eye, 1.0)]),
    (
        "clavicle clavicula clav collar collarbone scapula shoulderblade schlüsselbein clavicule clavícula \
         clavicola ключица 锁骨",
        &[(Slot::Clavicle, 1.0)],
    ),
    ("肩", &[(Slot::Clavicle, 1.0)]),
    (
        "shoulder shldr schulter épaule epaule hombro spalla ombro плечо",
        &[(Slot::Clavicle, 0.6), (Slot::UpperArm, 0.6)],
    ),
    ("upperarm uparm upparm armupper armup humerus oberarm 腕 上臂 大臂 shoulderjoint", &[(Slot::UpperArm, 1.0)]),
    ("arm bras brazo braccio braço braco рука", ARM),
    (
        "forearm lowerarm lowarm loarm armlower armlow elbow unterarm ellbogen ひじ avantbras coude antebrazo codo \
         avambraccio gomito antebraço antebraco cotovelo предплечье локоть 前臂 小臂 手肘",
        &[(Slot::LowerArm, 1.0)],
    ),
    // Wrist and hand in one chain: the hand begins at the wrist.
    ("wrist handgelenk 手首 poignet muñeca polso запястье 手腕", &[(Slot::Hand, 1.0)]),
    ("hand", &[(Slot::Hand, 0.95)]),
    ("palm", &[(Slot::Hand, 0.9)]),
    (
        "thigh upleg upperleg uppleg legupper legup femur oberschenkel hipjoint cuisse muslo coscia coxa \
         бедро 大腿",
        &[(Slot::UpperLeg, 1.0)],
    ),
    ("足", &[(Slot::UpperLeg, 1.0)]),
    ("leg bein jambe pierna gamba perna нога", LEG),
    (
        "lowerleg lowleg loleg leglower leglow calf shin shank knee tibia unterschenkel knie ひざ mollet genou \
         pantorrilla rodilla polpaccio ginocchio panturrilha joelho голень колено 小腿 膝 膝盖",
        &[(Slot::LowerLeg, 1.0)],
    ),
    ("ankle knöchel 足首 cheville tobillo caviglia tornozelo лодыжка 脚踝", &[(Slot::Foot, 1.0)]),
    ("foot fuss fuß", &[(Slot::Foot, 0.95), (Slot::Toes, 0.4)]),
    ("toe toes ball zeh zehen つま先 orteil orteils 脚趾 脚尖", &[(Slot::Toes, 1.0)]),
];

/// What a joint of an arm can be, of which no more is said.
pub const ARM: &[(Slot, f64)] =
    &[(Slot::UpperArm, 0.7), (Slot::LowerArm, 0.5), (Slot::Hand, 0.3), (Slot::Clavicle, 0.2)];

/// What a joint of a leg can be, of which no more is said.
pub const LEG: &[(Slot, f64)] = &[(Slot::UpperLeg, 0.6), (Slot::LowerLeg, 0.55), (Slot::Foot, 0.3), (Slot::Toes, 0.2)];

/// What the same words mean in the name of a joint that has a side.
const SIDED: &[(&str, &[(Slot, f64)])] = &[
    ("hip hüfte huefte", &[(Slot::UpperLeg, 0.8)]),
    ("main mano mão mao кисть 手", &[(Slot::Hand, 0.95)]),
    ("pied pie piede pé стопа 脚", &[(Slot::Foot, 0.95)]),
];

/// Words of joints that move others, or nothing.
const CONTROLS: &str = "ik fk ctrl ctl control controller target tgt pole mch org trajectory locator loc gizmo effector goal \
    handle tweak follow properties pv snap hinge reverse aim lookat vis interaction ｉｋ 操作中心 全ての親 センター グルーブ";

/// Words that stand for a control where no other word has a meaning.
const WEAK_CONTROLS: &str = "root origin world global reference master motion armature rig con parent null center centre \
    body character skeleton human humanoid model mesh base cog centerofmass";

/// Words of things that are held or worn.
const PROPS: &str = "slot weapon gun sword shield socket prop attach attachment attachpoint camera cam item holster mount \
    knife dagger bow arrow quiver bag backpack pouch grip muzzle magazine hold holder hardpoint gear";

/// Words of what hangs on a body.
const SECONDARY: &str = "hair bang bangs braid ponytail pigtail ahoge skirt cape cloak coat jacket cloth clothes robe dress \
    scarf sleeve ribbon tie belt strap string sash tassel hood hat helmet mask glasses earring jewel necklace breast \
    breasts boob boobs bust nipple pectoral pec glute butt buttock genital tail ear ears wing horn antenna fin spring jiggle \
    physics phys dyn dynamic sec secondary bounce wiggle tongue teeth tooth lip lips brow brows eyebrow eyebrows eyelid eyelids lid lids lash lashes eyelash eyelashes cheek \
    nose nostril mouth chin face facial forehead temple beard mustache whisker snout trunkfat bellyfat fat flap chain \
    feather fur 髪 スカート 胸 乳";

/// Words of helpers along a limb.
const TWISTS: &str = "twist roll bend share corrective correctiveroot muscle mus helper half volume bulge deltoid bicep \
    biceps tricep triceps trapezius trap latissimus lat ulna radius metatarsal kneecap patella segment seg 捩 腕捩 手捩 \
    rolldummy twistdummy adjust ligament";

/// Words of the end of a chain.
const ENDS: &str = "end nub tip top leaf site endsite terminal 先";

/// Words that say nothing.
const NOISE: &str = "node bone bones joint joints jnt jt bn bind skin sk def deform dfm c m x cn mid center centre bip biped b j \
    valve cc base rl geo hum adj ｄ";

/// Words of the fingers.
const FINGERS: &[(&str, Finger)] = &[
    ("thumb daumen pouce pulgar pollice polegar 親指 拇指", Finger::Thumb),
    ("index pointer forefinger zeigefinger índice indice indicador указательный 人指 人差指 食指", Finger::Index),
    ("middle mid mittelfinger majeur medio médio средний 中指", Finger::Middle),
    ("ring ringfinger annulaire anular anulare anelar безымянный 薬指 无名指", Finger::Ring),
    (
        "pinky pinkie pink little small kleinerfinger auriculaire meñique menique mignolo mínimo minimo мизинец 小指",
        Finger::Little,
    ),
];

/// Words of the bones of a finger, with their places.
const SEGMENTS: &[(&str, u8)] = &[
    ("metacarpal meta carpal palm start", 0),
    ("proximal prox", 1),
    ("intermediate inter medial", 2),
    ("distal dist", 3),
];

/// Words that names are made of where they stand without separators; together with those of the rows above.
const PIECES: &str = "up low upper lower fore finger heel big";

/// What one word can mean.
#[derive(Clone, Copy, Default)]
struct Entry {
    parts: &'static [(Slot, f64)],
    sided: &'static [(Slot, f64)],
    finger: Option<Finger>,
    segment: Option<u8>,
    is_control: bool,
    is_weak_control: bool,
    is_prop: bool,
    is_secondary: bool,
    is_twist: bool,
    is_end: bool,
    is_piece: bool,
    is_noise: bool,
}

/// All rows, to look words up in.
pub struct Vocabulary {
    entries: HashMap<&'static str, Entry>,
}

impl Default for Vocabulary {
    fn default() -> Self {
        let mut entries: HashMap<&'static str, Entry> = HashMap::new();
        let mut add = |row: &'static str, set: &dyn Fn(&mut Entry)| {
            for word in row.split_ascii_whitespace() {
                set(entries.entry(word).or_default());
            }
        };
        for &(row, parts) in PARTS {
            add(row, &|entry| entry.parts = parts);
        }
        for &(row, parts) in SIDED {
            add(row, &|entry| entry.sided = parts);
        }
        for &(row, finger) in FINGERS {
            add(row, &|entry| entry.finger = Some(finger));
        }
        for &(row, segment) in SEGMENTS {
            add(row, &|entry| entry.segment = Some(segment));
        }
        add(CONTROLS, &|entry| entry.is_control = true);
        add(WEAK_CONTROLS, &|entry| entry.is_weak_control = true);
        add(PROPS, &|entry| entry.is_prop = true);
        add(SECONDARY, &|entry| entry.is_secondary = true);
        add(TWISTS, &|entry| entry.is_twist = true);
        add(ENDS, &|entry| entry.is_end = true);
        add(PIECES, &|entry| entry.is_piece = true);
        add(NOISE, &|entry| entry.is_noise = true);
        Self { entries }
    }
}

/// What a name says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meaning {
    /// Parts of the body with how surely the name means them.
    pub parts: Vec<(Slot, f64)>,
    /// A helper, control, prop or what hangs on the body.
    pub class: Option<Slot>,
    /// A bone of a finger.
    pub finger: Option<FingerBone>,
}

impl Meaning {
    fn class(slot: Slot) -> Self {
        Self { class: Some(slot), ..Self::default() }
    }
}

/// A bone of a finger as its name has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FingerBone {
    /// Which finger.
    pub finger: Finger,
    /// Which bone.
    pub place: Place,
}

/// Which bone of a finger a name says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A segment, as in [`super::super::body_part::BodyPart::Finger`].
    Segment(u8),
    /// A number that counts from the first bone that the rig has.
    Number(u32),
    /// Nothing: the order in the chain decides.
    Unsaid,
}

impl Vocabulary {
    fn entry(&self, word: &str) -> Entry {
        self.entries.get(word).copied().unwrap_or_default()
    }

    /// Whether a word has a meaning of its own.
    pub fn is_known(&self, word: &str) -> bool {
        self.entries.get(word).is_some_and(|entry| !entry.is_noise && !entry.is_weak_control)
    }

    /// Whether a word is about a part of the body.
    pub fn is_body(&self, word: &str) -> bool {
        let entry = self.entry(word);
        entry.is_piece || entry.is_end || !entry.parts.is_empty() || entry.finger.is_some() || entry.segment.is_some()
    }

    /// Reads the words of a name that has a side, or none.
    pub fn read(&self, words: &[String], has_side: bool) -> Meaning {
        let number = words.iter().rev().find(|word| is_number(word)).and_then(|word| word.parse().ok());
        let words: Vec<String> =
            words.iter().filter(|word| !is_number(word)).flat_map(|word| self.pieces(word)).collect();
        let entries: Vec<Entry> = words.iter().map(|word| self.entry(word)).collect();
        let any = |is: fn(&Entry) -> bool| entries.iter().any(is);
        let says = |one: &[&str]| words.iter().any(|word| one.contains(&word.as_str()));
        if any(|entry| entry.is_control) {
            return Meaning::class(Slot::Control);
        }
        if any(|entry| entry.is_prop) {
            return Meaning::class(Slot::Prop);
        }
        if any(|entry| entry.is_secondary) {
            return Meaning::class(Slot::Secondary);
        }
        if any(|entry| entry.is_twist) {
            // What rolls a foot moves it; what rolls a limb is moved.
            let is_control = says(&["roll"]) && says(&["foot", "heel", "toe", "ball"]);
            return Meaning::class(if is_control { Slot::Control } else { Slot::Twist });
        }
        if says(&["toe", "toes", "foot"]) && (any(|entry| entry.finger.is_some()) || says(&["big"])) {
            // One toe of five.
            return Meaning::class(Slot::Twist);
        }
        let is_end = any(|entry| entry.is_end);
        if let Some(finger) = finger(&words, &entries, number, is_end) {
            return Meaning { finger: Some(finger), ..Meaning::default() };
        }
        let rest: Vec<&str> = words
            .iter()
            .map(String::as_str)
            .zip(&entries)
            .filter(|(_, e)| !e.is_noise && !e.is_end)
            .map(|(word, _)| word)
            .collect();
        let parts = self.phrase(&rest, has_side);
        if parts.is_empty() {
            let is_control =
                any(|entry| entry.is_weak_control) && entries.iter().all(|e| e.is_noise || e.is_weak_control);
            let parts = if says(&["root", "cog"]) { vec![(Slot::Hips, ROOT)] } else { Vec::new() };
            return if is_control { Meaning { parts, ..Meaning::class(Slot::Control) } } else { Meaning::default() };
        }
        let unknown = rest.iter().filter(|word| !self.helps(word)).count();
        let share = UNKNOWN_WORD.powi(unknown.min(8) as i32);
        let parts = match (is_end, parts[0].0) {
            (false, _) => parts.iter().map(|&(slot, strength)| (slot, share * strength)).collect(),
            (true, Slot::Head) => vec![(Slot::HeadTop, share)],
            (true, Slot::Toes) => vec![(Slot::ToeTip, share)],
            _ => return Meaning::class(Slot::Twist),
        };
        Meaning { parts, ..Meaning::default() }
    }

    /// What the longest run of words that means a part means, the last of several. `arm` and `leg` say less than any other
    /// word: in `arm_elbow` they say only which limb it is.
    fn phrase(&self, words: &[&str], has_side: bool) -> &'static [(Slot, f64)] {
        let mut vague: &[(Slot, f64)] = &[];
        // No row has more than three words in one.
        for length in (1..=words.len().min(3)).rev() {
            for run in words.windows(length).rev() {
                let entry = self.entry(&run.concat());
                let parts = if has_side && !entry.sided.is_empty() { entry.sided } else { entry.parts };
                if parts == ARM || parts == LEG {
                    vague = parts;
                } else if !parts.is_empty() {
                    return parts;
                }
            }
        }
        vague
    }

    /// Whether a word means a part by itself, or helps to.
    fn helps(&self, word: &str) -> bool {
        let entry = self.entry(word);
        entry.is_piece || entry.is_weak_control || !entry.parts.is_empty()
    }

    /// A word that is several without separators, such as `handslot`, in its pieces; itself where it is none.
    fn pieces(&self, word: &str) -> Vec<String> {
        let is_long = word.len() < 5 || word.len() > LONGEST_WORD;
        if self.is_known(word) || is_long || !word.is_ascii() {
            return vec![word.to_owned()];
        }
        // From each place the longest word after which the rest can be split too.
        let mut next: Vec<Option<usize>> = vec![None; word.len()];
        for from in (0..word.len()).rev() {
            let can = |&to: &usize| {
                let is_word = to - from > 1 && self.entries.contains_key(&word[from..to]);
                is_word && (to == word.len() || next[to].is_some())
            };
            next[from] = (from + 1..=word.len()).rev().find(can);
        }
        let (mut at, mut pieces) = (0, Vec::new());
        while at < word.len() {
            let Some(to) = next[at] else { return vec![word.to_owned()] };
            pieces.push(word[at..to].to_owned());
            at = to;
        }
        pieces
    }
}

/// How surely a root is the hips.
const ROOT: f64 = 0.15;
/// Each word without a meaning leaves so much of what the others mean.
const UNKNOWN_WORD: f64 = 0.75;
/// Longer words are no names of joints.
const LONGEST_WORD: usize = 32;

fn finger(words: &[String], entries: &[Entry], number: Option<u32>, is_end: bool) -> Option<FingerBone> {
    let finger = entries.iter().find_map(|entry| entry.finger)?;
    let segment = entries.iter().find_map(|entry| entry.segment);
    let belongs = |(word, entry): &(&String, &Entry)| {
        let says_finger = matches!(word.as_str(), "hand" | "finger" | "f" | "phalange" | "phalanx" | "in");
        entry.finger.is_some() || entry.segment.is_some() || entry.is_noise || entry.is_end || says_finger
    };
    // `mid` and `little` stand for other things than fingers, where no other word is about hands.
    let sure = ["thumb", "index", "pinky", "pinkie", "daumen", "finger", "hand"];
    let is_sure = words.iter().any(|word| sure.contains(&word.as_str()));
    if words.iter().zip(entries).filter(|both| !belongs(both)).count() > usize::from(is_sure) {
        return None;
    }
    let place = match (is_end, segment, number) {
        (true, ..) => Place::Segment(4),
        (_, Some(segment), _) => Place::Segment(segment),
        (.., Some(number)) => Place::Number(number),
        _ => Place::Unsaid,
    };
    Some(FingerBone { finger, place })
}
