#include "options.h"

#include <stdlib.h>
#include <string.h>

/* What an option takes, and so the type of its field. */
typedef enum Kind {
    FLAG,     /* nothing: bool */
    PATH,     /* const char * */
    NEEDED,   /* the same, and it has to be there */
    LAYER,    /* a path, each time one more */
    NUMBER,   /* double, from 0 */
    POSITIVE, /* double, above 0 */
    COUNT,    /* double that is a whole number up to `most` */
} Kind;

typedef struct Entry {
    const char *name;
    Kind kind;
    size_t field;
    double most;
} Entry;

#define FIELD(name) offsetof(Options, name)

static const Entry entries[] = {
    {"--garment", NEEDED, FIELD(garment), 0.0},
    {"--source-skeleton", NEEDED, FIELD(source_skeleton), 0.0},
    {"--avatar", NEEDED, FIELD(avatar), 0.0},
    {"--target-skeleton", NEEDED, FIELD(target_skeleton), 0.0},
    {"--output", NEEDED, FIELD(output), 0.0},
    {"-o", PATH, FIELD(output), 0.0},
    {"--source-avatar", PATH, FIELD(source_avatar), 0.0},
    {"--skin-weights", PATH, FIELD(skin_weights), 0.0},
    {"--layer", LAYER, FIELD(layers), 0.0},
    {"--no-fit", PATH, FIELD(no_fit), 0.0},
    {"--pins", PATH, FIELD(pins), 0.0},
    {"--rigid", PATH, FIELD(rigid), 0.0},
    {"--output-avatar", PATH, FIELD(output_avatar), 0.0},
    {"--distortion", PATH, FIELD(distortion), 0.0},
    {"--report", PATH, FIELD(report), 0.0},
    {"--keep-partial", PATH, FIELD(keep_partial), 0.0},
    {"--fit-weight", NUMBER, FIELD(fit_weight), 0.0},
    {"--designed-clearance", NUMBER, FIELD(designed_clearance), 0.0},
    {"--offset", NUMBER, FIELD(offset), 0.0},
    {"--fit-distance", NUMBER, FIELD(fit_distance), 0.0},
    {"--pin-weight", POSITIVE, FIELD(pin_weight), 0.0},
    {"--threads", COUNT, FIELD(threads), 1024.0},
    {"--memory-limit", POSITIVE, FIELD(memory_limit), 0.0},
    {"--strict", FLAG, FIELD(strict), 0.0},
    {"--surface-weight", NUMBER, FIELD(surface_weight), 0.0},
    {"--curve-weight", NUMBER, FIELD(curve_weight), 0.0},
    {"--curvature-weight", NUMBER, FIELD(curvature_weight), 0.0},
    {"--torsion-weight", NUMBER, FIELD(torsion_weight), 0.0},
    {"--position-weight", NUMBER, FIELD(position_weight), 0.0},
    {"--barrier-weight", POSITIVE, FIELD(barrier_weight), 0.0},
    {"--dhat", POSITIVE, FIELD(dhat), 0.0},
    {"--inflation-dhat", POSITIVE, FIELD(inflation_dhat), 0.0},
    {"--inflation-barrier-weight", POSITIVE, FIELD(inflation_barrier_weight), 0.0},
    {"--voxel-size", POSITIVE, FIELD(voxel_size), 0.0},
    {"--voxel", POSITIVE, FIELD(voxel_size), 0.0}, /* its name until 0.1 */
    {"--min-separation", POSITIVE, FIELD(min_separation), 0.0},
    {"--tolerance", POSITIVE, FIELD(tolerance), 0.0},
    {"--max-iterations", COUNT, FIELD(max_iterations), 4294967295.0},
    {"--printed-surface", FLAG, FIELD(printed_surface), 0.0},
    {"--quiet", FLAG, FIELD(quiet), 0.0},
    {"--help", FLAG, FIELD(help), 0.0},
    {"-h", FLAG, FIELD(help), 0.0},
    {"--version", FLAG, FIELD(version), 0.0},
};

#define ENTRY_COUNT (sizeof entries / sizeof *entries)

static void *field_of(Options *options, const Entry *entry) {
    return (char *)options + entry->field;
}

static bool is_number(const Entry *entry) {
    return entry->kind == NUMBER || entry->kind == POSITIVE || entry->kind == COUNT;
}

static const Entry *find(const char *name, size_t length) {
    for (size_t k = 0; k < ENTRY_COUNT; k++) {
        if (strlen(entries[k].name) == length && strncmp(name, entries[k].name, length) == 0) {
            return &entries[k];
        }
    }
    return NULL;
}

static bool set_number(double *number, const Entry *entry, const char *value, Message *message) {
    const Word word = {value, value + strlen(value)};
    const bool is_positive = entry->kind == POSITIVE;
    if (!word_number(word, number) || *number < 0.0 || (is_positive && *number == 0.0)) {
        return fail(message, "option %s has '%s', which is not a number %s", entry->name, value,
                    is_positive ? "above 0" : "from 0");
    }
    if (entry->kind == COUNT && (*number > entry->most || *number != (double)(uint32_t)*number)) {
        return fail(message, "option %s must be a whole number up to %.0f", entry->name, entry->most);
    }
    return true;
}

static bool set_value(Options *options, const Entry *entry, const char *value, Message *message) {
    void *field = field_of(options, entry);
    if (is_number(entry)) {
        return set_number(field, entry, value, message);
    }
    if (entry->kind == LAYER) {
        options->layers[options->layer_count++] = value;
    } else {
        *(const char **)field = value;
    }
    return true;
}

/* --name, --name value or --name=value, word by word. */
static bool read_words(Options *options, int count, char **words, Message *message) {
    for (int i = 1; i < count; i++) {
        const char *equals = strchr(words[i], '=');
        const size_t length = equals != NULL ? (size_t)(equals - words[i]) : strlen(words[i]);
        const Entry *entry = find(words[i], length);
        if (entry == NULL || (entry->kind == FLAG && equals != NULL)) {
            return fail(message, "there is no option '%s'; see retarget --help", words[i]);
        }
        if (entry->kind == FLAG) {
            *(bool *)field_of(options, entry) = true;
            continue;
        }
        const char *value = equals != NULL ? equals + 1 : i + 1 < count ? words[++i] : NULL;
        if (value == NULL || *value == '\0') {
            return fail(message, "option %s needs a value", entry->name);
        }
        if (!set_value(options, entry, value, message)) {
            return false;
        }
    }
    return true;
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
    const char *outputs[] = {options->output, options->output_avatar, options->report,
                             options->distortion, options->keep_partial, options->partial_avatar};
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
    for (size_t k = 0; k < ENTRY_COUNT; k++) {
        if (is_number(&entries[k])) {
            *(double *)field_of(options, &entries[k]) = -1.0;
        }
    }
    options->layers = array_new((size_t)count, sizeof *options->layers);
    if (options->layers == NULL) {
        return fail(message, "the command line does not fit into memory");
    }
    if (!read_words(options, count, words, message)) {
        return false;
    }
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
    free(options->partial_avatar);
    memset(options, 0, sizeof *options);
}
