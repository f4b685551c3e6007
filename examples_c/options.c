#include "options.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "space.h"

/* What a row of the table is, and so the type of its field. */
typedef enum Kind {
    TEXT,      /* no option: what stands between them in --help */
    PATH,      /* const char * */
    NEEDED,    /* the same, and it has to be there */
    LAYER,     /* a path, each time one more */
    PATHS,     /* the same: Paths */
    FLAG,      /* no value: bool */
    CHOICE,    /* no value: uint32_t that becomes `number` */
    WEIGHT,    /* double from 0, where 0 switches something off */
    FROM_ZERO, /* double from 0, where 0 is the default */
    POSITIVE,  /* double above 0 */
    COUNT,     /* uint32_t up to `number` */
    MEGABYTES, /* a number above 0: uint64_t, in bytes */
    SPACE,     /* words between commas: BespokeCoordinateSystem */
} Kind;

typedef struct Entry {
    const char *name;
    const char *value; /* how --help names what the option takes */
    Kind kind;
    size_t field; /* where it goes, in Options */
    uint32_t number;
    const char *help; /* ",": the next option shares its line; null: it is not listed */
} Entry;

#define FIELD(name) offsetof(Options, name)

/* In the order of --help. */
static const Entry entries[] = {
    {"--garment", "FILE", NEEDED, FIELD(garment), 0, "the garment, around the source skeleton"},
    {"--source-skeleton", "FILE", PATH, FIELD(source_skeleton), 0,
     "skeleton of the body it was modelled on: joints as v, bones as l lines"},
    {"--source-rig", "FILE", PATH, FIELD(source_rig), 0,
     "or its rig: a line 'joint NAME PARENT' and the 16 numbers of the bind transform for each"},
    {"--avatar", "FILE", NEEDED, FIELD(avatar), 0, "the body to dress"},
    {"--target-skeleton", "FILE", PATH, FIELD(target_skeleton), 0,
     "its skeleton: the same joints in the same order, the same bones in any order"},
    {"--target-rig", "FILE", PATH, FIELD(target_rig), 0, "or its rig, with whatever joints it has"},
    {"-o", "", PATH, FIELD(output), 0, ","},
    {"--output", "FILE", NEEDED, FIELD(output), 0,
     "the garment on the avatar, in the avatar's coordinate system and unit"},
    {"", "", TEXT, 0, 0, "\nWhat else there is to know:\n"},
    {"--source-avatar", "FILE", PATH, FIELD(source_avatar), 0,
     "the body the garment was modelled on; the fit then aims at the looseness it had there"},
    {"--skin-weights", "FILE", PATH, FIELD(skin_weights), 0,
     "skin weights of the avatar: a text matrix, a row for each joint, a column for each vertex"},
    {"--target-skin", "FILE", PATH, FIELD(target_skin), 0,
     "the same as a line 'JOINT WEIGHT JOINT WEIGHT ...' for each vertex, joints from 0"},
    {"--source-skin", "FILE", PATH, FIELD(source_skin), 0, "the same of the source avatar, on the source rig"},
    {"--output-skin", "FILE", PATH, FIELD(output_skin), 0,
     "writes skin weights of the result on the target rig, up to 8 a vertex, in lines as above"},
    {"--output-rig", "FILE", PATH, FIELD(output_rig), 0,
     "writes the target rig with the garment's own joints, such as those of a skirt, after its own"},
    {"--garment-skin", "FILE", PATH, FIELD(garment_skin), 0,
     "skin weights of the garment on the source rig: what is on joints of its own comes along"},
    {"--joint-pairs", "FILE", PATH, FIELD(joint_pairs), 0,
     "joints of source rig and target rig that correspond, where the names do not say it: two\n"
     "numbers in a line, from 0"},
    {"--joint-map", "FILE", PATH, FIELD(joint_map), 0,
     "writes which joints of the two rigs correspond, why, and how sure that is"},
    {"--source-space", "AXES", SPACE, FIELD(source_space), 0,
     "axes of garment, source skeleton and source avatar that point right, up and forward, and\n"
     "metres a unit where that is not 1: -x,y,z or y,z,x,0.01 (x,y,-z). With ',trusted' at its end\n"
     "nothing is turned or refused for unit, axes, facing and sides"},
    {"--target-space", "AXES", SPACE, FIELD(target_space), 0, "the same of avatar, layers and target skeleton"},
    {"--layer", "FILE", LAYER, FIELD(layers), 0,
     "a garment that the avatar wears already, placed like it; may be given several times"},
    {"--ignore-groups", "NAMES", PATH, FIELD(ignore_groups), 0,
     "objects, groups or materials of the avatar's file that take no part, separated by commas:\n"
     "the garment may pass through them"},
    {"--collision-groups", "NAMES", PATH, FIELD(collision_groups), 0,
     "those that the garment does not pass through, but is not fitted to, such as hair"},
    {"--body-groups", "NAMES", PATH, FIELD(body_groups), 0,
     "those that are body in any case, where a piece would be left out as no part of it"},
    {"--garment-normals", "", FLAG, FIELD(garment_normals), 0,
     "turns the vertex normals of the garment's file as the garment has turned; without it, they are\n"
     "computed afresh from the faces"},
    {"--follower", "FILE", PATHS, FIELD(followers), 0,
     "a mesh that follows the garment without being solved, such as a level of detail, a trim or a\n"
     "badge: x.obj gets x.follower-0.obj beside it, and so on; may be given several times"},
    {"--garment-morph", "FILE", PATHS, FIELD(garment_morphs), 0,
     "the garment in another shape, as a blend shape at weight 1: x.obj gets x.garment-morph-0.obj\n"
     "beside it; may be given several times"},
    {"--target-morph", "FILE", PATHS, FIELD(target_morphs), 0,
     "the avatar in another shape: x.obj gets x.target-morph-0.obj, the garment on it; may be\n"
     "given several times"},
    {"--no-fit", "FILE", PATH, FIELD(no_fit), 0,
     "garment vertices (from 0); faces with all corners listed are not drawn to the body"},
    {"--pins", "FILE", PATH, FIELD(pins), 0,
     "garment vertices to hold, a line each: the vertex (from 0) alone goes with its bone, or\n"
     "the vertex and the x y z where it is to be; the same in all lines"},
    {"--rigid", "FILE", PATH, FIELD(rigid), 0,
     "groups of garment vertices (from 0) that stay rigid, such as buttons: a line for each"},
    {"--curves", "FILE", PATH, FIELD(curves), 0,
     "curves along edges of the garment that keep shape and place, such as a neckline: a line for\n"
     "each, open or closed, factors on --curve-weight and --position-weight, vertices (from 0)"},
    {"", "", TEXT, 0, 0, "\nHow it fits:\n"},
    {"--fit-weight", "W", WEIGHT, FIELD(library.fit_weight), 0, "how tight (2); 0 switches the term off"},
    {"--designed-clearance", "X", WEIGHT, FIELD(library.designed_clearance), 0,
     "with --source-avatar: how much of the looseness it had there to aim at (1); 0 is tight"},
    {"--offset", "D", FROM_ZERO, FIELD(library.offset), 0,
     "clearance to aim at everywhere beside that, in the unit of the avatar (0)"},
    {"--fit-distance", "D", WEIGHT, FIELD(library.fit_distance), 0,
     "with --source-avatar, without --no-fit: what was designed up to D away from it fits, what\n"
     "was twice as far hangs (0.1; the skeleton is 2 long); 0: the whole garment fits"},
    {"--weld-distance", "X", WEIGHT, FIELD(library.weld_distance), 0,
     "close seams whose sides are nearer than this share of the mean edge (0.01); 0: none"},
    {"--pin-weight", "W", POSITIVE, FIELD(library.pin_weight), 0, "stiffness of the pins (1000)"},
    {"--threads", "N", COUNT, FIELD(library.threads), 1024, "0: all cores, and never more than these (0)"},
    {"--memory-limit", "MB", MEGABYTES, FIELD(library.memory_limit), 0,
     "give up where more memory would be needed (no limit)"},
    {"--strict", "", CHOICE, FIELD(library.strict), 1,
     "refuse a garment that intersects itself, instead of exempting those triangles from contact\n"
     "until they separate"},
    {"--keep-caps", "", CHOICE, FIELD(library.keep_caps), 1,
     "refuse a garment that is closed where bones leave it, as at neck, cuffs and hems, instead of\n"
     "leaving these triangles out while it is fitted"},
    {"", "", TEXT, 0, 0, "\nFor experts; the skeleton is 2 long in all lengths:\n"},
    {"--surface-weight", "W", WEIGHT, FIELD(library.surface_weight), 0, "how strongly the design keeps its shape (1)"},
    {"--curve-weight", "W", WEIGHT, FIELD(curve_weight), 0,
     "the same for its boundary curves: curvature and torsion (2.5)"},
    {"--curvature-weight", "W", WEIGHT, FIELD(library.curvature_weight), 0, ","},
    {"--torsion-weight", "W", WEIGHT, FIELD(library.torsion_weight), 0, "one of the two alone"},
    {"--position-weight", "W", WEIGHT, FIELD(library.position_weight), 0,
     "how strongly cuffs, hems and collars keep their place along their bones (10)"},
    {"--barrier-weight", "W", POSITIVE, FIELD(library.barrier_weight), 0, "stiffness of contacts (1e8)"},
    {"--dhat", "D", POSITIVE, FIELD(library.dhat), 0, "distance at which contacts begin (0.002)"},
    {"--inflation-dhat", "D", POSITIVE, FIELD(library.inflation_dhat), 0,
     "the same while the avatar grows inside the garment (0.01)"},
    {"--inflation-barrier-weight", "W", POSITIVE, FIELD(library.inflation_barrier_weight), 0,
     "stiffness of contacts while the avatar grows (1e4)"},
    {"--voxel-size", "D", POSITIVE, FIELD(library.voxel_size), 0,
     "resolution of the distance field (0.01); also --voxel"},
    {"--min-separation", "D", POSITIVE, FIELD(library.min_separation), 0, "distance that nothing falls below (1e-5)"},
    {"--tolerance", "X", POSITIVE, FIELD(library.tolerance), 0,
     "the fit ends where what a step still promises is below this part of the objective (1e-3)"},
    {"--max-iterations", "N", COUNT, FIELD(library.max_iterations), UINT32_MAX,
     "iterations of each stage at most (500)"},
    {"--printed-surface", "", CHOICE, FIELD(library.surface_form), BESPOKE_SURFACE_FORM_PRINTED,
     "the surface term as printed in the paper, which makes scaling cost something"},
    {"--surface-length", "D", WEIGHT, FIELD(library.surface_length), 0,
     "distance across two triangles at which they weigh their area in the surface term (0.048); 0\n"
     "weighs all by their area, so that fine garments are softer"},
    {"--curve-chord", "D", WEIGHT, FIELD(library.curve_chord), 0,
     "distance along a boundary curve at which its bends are read (0.08); 0 reads them at its\n"
     "vertices, so that fine curves are softer"},
    {"", "", TEXT, 0, 0,
     "\n"
     "A message may name an option of the library: inflation_dhat is set by --inflation-dhat, and so on, surface_form by\n"
     "--printed-surface.\n"
     "\n"
     "What is written besides:\n"},
    {"--output-avatar", "FILE", PATH, FIELD(output_avatar), 0, "the avatar that was dressed, written as it was read"},
    {"--distortion", "FILE", PATH, FIELD(distortion), 0,
     "how much each triangle is distorted: a number a line, in the order of the faces and of the\n"
     "triangles of their fans; 0 where the garment is similar to its design"},
    {"--output-covered", "FILE", PATH, FIELD(output_covered), 0,
     "the triangles of the avatar that the garment covers, so that a game may leave them out: a\n"
     "number a line, from 0, in the order of the faces and of the triangles of their fans"},
    {"--covered-margin", "N", COUNT, FIELD(covered_margin), 1000,
     "so many rings of triangles are left beside those that are not covered (1)"},
    {"--covered-openness", "S", FROM_ZERO, FIELD(covered_openness), 0,
     "the share of directions, up to 1, in which a covered triangle may be seen all the same (0)"},
    {"--report", "FILE", PATH, FIELD(report), 0,
     "a JSON file with status, message, times, iterations, energies, distances, counts and\n"
     "diagnostics; also where there is no result"},
    {"--keep-partial", "FILE", PATH, FIELD(keep_partial), 0,
     "only where there is no result: the garment as it was last, and beside it the avatar as far\n"
     "as it had grown (x.obj: x.avatar.obj), to see where it is stuck; not verified"},
    {"--quiet", "", FLAG, FIELD(quiet), 0, "no progress on standard output, no warnings and notes on standard error"},
    {"--help", "", FLAG, FIELD(help), 0, ","},
    {"--version", "", FLAG, FIELD(version), 0, ""},
    /* Other names; --voxel was the name until 0.1. */
    {"-h", "", FLAG, FIELD(help), 0, NULL},
    {"--voxel", "D", POSITIVE, FIELD(library.voxel_size), 0, NULL},
};

#define ENTRY_COUNT (sizeof entries / sizeof *entries)

static bool has_value(const Entry *entry) {
    return entry->kind != FLAG && entry->kind != CHOICE;
}

static const Entry *find(const char *name, size_t length) {
    for (size_t k = 0; k < ENTRY_COUNT; k++) {
        if (entries[k].kind != TEXT && strlen(entries[k].name) == length &&
            strncmp(name, entries[k].name, length) == 0) {
            return &entries[k];
        }
    }
    return NULL;
}

static bool read_number(double *number, const Entry *entry, const char *value, Message *message) {
    const Word word = {value, value + strlen(value)};
    const bool is_positive = entry->kind == POSITIVE || entry->kind == MEGABYTES;
    if (!word_number(word, number) || *number < 0.0 || (is_positive && *number == 0.0)) {
        return fail(message, "option %s has '%s', which is not a number %s", entry->name, value,
                    is_positive ? "above 0" : "from 0");
    }
    if (entry->kind == COUNT && (*number > (double)entry->number || *number != (double)(uint32_t)*number)) {
        return fail(message, "option %s must be a whole number up to %" PRIu32, entry->name, entry->number);
    }
    return true;
}

static bool set_number(void *field, const Entry *entry, const char *value, Message *message) {
    double number;
    if (!read_number(&number, entry, value, message)) {
        return false;
    }
    if (entry->kind == COUNT) {
        *(uint32_t *)field = (uint32_t)number;
    } else if (entry->kind == MEGABYTES) {
        *(uint64_t *)field = number < 1e13 ? (uint64_t)(1e6 * number) : UINT64_MAX;
    } else {
        *(double *)field = entry->kind == WEIGHT && number == 0.0 ? BESPOKE_WEIGHT_OFF : number;
    }
    return true;
}

/* The value is null where there is none. */
static bool set_field(Options *options, const Entry *entry, const char *value, Message *message) {
    void *field = (char *)options + entry->field;
    switch (entry->kind) {
    case TEXT:
        return true;
    case PATH:
    case NEEDED:
        *(const char **)field = value;
        return true;
    case LAYER:
        options->layers[options->layer_count++] = value;
        return true;
    case PATHS: {
        Paths *paths = field;
        paths->paths[paths->count++] = value;
        return true;
    }
    case FLAG:
        *(bool *)field = true;
        return true;
    case CHOICE:
        *(uint32_t *)field = entry->number;
        return true;
    case SPACE:
        return space_read((BespokeCoordinateSystem *)field, entry->name, value, message);
    default:
        return set_number(field, entry, value, message);
    }
}

/* --name, --name value or --name=value, word by word. */
static bool read_words(Options *options, int count, char **words, Message *message) {
    for (int i = 1; i < count; i++) {
        const char *equals = strchr(words[i], '=');
        const size_t length = equals != NULL ? (size_t)(equals - words[i]) : strlen(words[i]);
        const Entry *entry = find(words[i], length);
        if (entry == NULL || (equals != NULL && !has_value(entry))) {
            return fail(message, "there is no option '%s'; see retarget --help", words[i]);
        }
        const char *value = NULL;
        if (has_value(entry)) {
            value = equals != NULL ? equals + 1 : i + 1 < count ? words[++i] : NULL;
            if (value == NULL || *value == '\0') {
                return fail(message, "option %s needs a value", entry->name);
            }
        }
        if (!set_field(options, entry, value, message)) {
            return false;
        }
    }
    return true;
}

/* Curvature and torsion follow --curve-weight, wherever it stands; their own weights come first. */
static void share_curve_weight(Options *options) {
    BespokeOptions *library = &options->library;
    if (library->curvature_weight == 0.0) {
        library->curvature_weight = options->curve_weight;
    }
    if (library->torsion_weight == 0.0) {
        library->torsion_weight = options->curve_weight;
    }
}

/* partial.obj: partial.avatar.obj; a name that does not end with .obj gets .avatar.obj at its end. */
static char *avatar_beside(const char *path) {
    static const char end[] = ".obj";
    const size_t length = strlen(path);
    const bool has_end = length > strlen(end) && strcmp(path + length - strlen(end), end) == 0;
    const size_t stem = has_end ? length - strlen(end) : length;
    char *beside = array_new(stem + sizeof ".avatar.obj", 1);
    if (beside != NULL) {
        memcpy(beside, path, stem);
        memcpy(beside + stem, ".avatar.obj", sizeof ".avatar.obj");
    }
    return beside;
}

static bool check(const Options *options, Message *message) {
    for (size_t k = 0; k < ENTRY_COUNT; k++) {
        if (entries[k].kind == NEEDED && *(const char *const *)((const char *)options + entries[k].field) == NULL) {
            return fail(message, "%s is missing; see retarget --help", entries[k].name);
        }
    }
    if (options->source_skeleton == NULL && options->source_rig == NULL) {
        return fail(message, "--source-skeleton or --source-rig is missing; see retarget --help");
    }
    if (options->target_skeleton == NULL && options->target_rig == NULL) {
        return fail(message, "--target-skeleton or --target-rig is missing; see retarget --help");
    }
    if (options->skin_weights != NULL && options->target_skin != NULL) {
        return fail(message, "--skin-weights and --target-skin are the same; give one of them");
    }
    if (options->covered_openness > 1.0) {
        return fail(message, "option --covered-openness must be a number from 0 to 1");
    }
    const char *outputs[] = {options->output, options->output_avatar, options->report,
                             options->distortion, options->keep_partial, options->partial_avatar,
                             options->joint_map, options->output_skin, options->output_rig,
                             options->output_covered};
    for (size_t a = 0; a < sizeof outputs / sizeof *outputs; a++) {
        for (size_t b = 0; b < a; b++) {
            if (outputs[a] != NULL && outputs[b] != NULL && strcmp(outputs[a], outputs[b]) == 0) {
                return fail(message, "%s is named for two different outputs", outputs[a]);
            }
        }
    }
    return true;
}

bool options_parse(Options *options, int count, char **words, Message *message) {
    memset(options, 0, sizeof *options);
    options->library.struct_size = sizeof options->library;
    options->covered_margin = 1;
    options->layers = array_new((size_t)count, sizeof *options->layers);
    options->followers.paths = array_new((size_t)count, sizeof *options->followers.paths);
    options->garment_morphs.paths = array_new((size_t)count, sizeof *options->garment_morphs.paths);
    options->target_morphs.paths = array_new((size_t)count, sizeof *options->target_morphs.paths);
    if (options->layers == NULL || options->followers.paths == NULL || options->garment_morphs.paths == NULL ||
        options->target_morphs.paths == NULL) {
        return fail(message, "the command line does not fit into memory");
    }
    if (!read_words(options, count, words, message)) {
        return false;
    }
    share_curve_weight(options);
    if (options->help || options->version) {
        return true;
    }
    options->partial_avatar = options->keep_partial != NULL ? avatar_beside(options->keep_partial) : NULL;
    if (options->keep_partial != NULL && options->partial_avatar == NULL) {
        return fail(message, "the command line does not fit into memory");
    }
    return check(options, message);
}

void options_free(Options *options) {
    free(options->layers);
    free(options->followers.paths);
    free(options->garment_morphs.paths);
    free(options->target_morphs.paths);
    free(options->partial_avatar);
    memset(options, 0, sizeof *options);
}

/* Puts the text of an option into its column, where the line has `width` characters already; after a long name it
   begins a new line. */
static void print_help(const char *help, int width, FILE *file) {
    const int column = 26;
    if (*help == '\0' || width > column - 2) {
        fputc('\n', file);
        width = 0;
    }
    while (*help != '\0') {
        const size_t length = strcspn(help, "\n");
        fprintf(file, "%*s%.*s\n", column - width, "", (int)length, help);
        help += help[length] == '\n' ? length + 1 : length;
        width = 0;
    }
}

void options_print_usage(FILE *file) {
    fputs(usage_begin, file);
    int width = 0;
    for (size_t k = 0; k < ENTRY_COUNT; k++) {
        const Entry *entry = &entries[k];
        if (entry->kind == TEXT) {
            fputs(entry->help, file);
        } else if (entry->help != NULL) {
            width += fprintf(file, "%s%s%s%s", width == 0 ? "  " : ", ", entry->name,
                             *entry->value != '\0' ? " " : "", entry->value);
            if (strcmp(entry->help, ",") != 0) {
                print_help(entry->help, width, file);
                width = 0;
            }
        }
    }
    fputs(usage_end, file);
}
