#include "options.h"

#include <stdlib.h>
#include <string.h>

const char *const options_usage =
    "usage: retarget --garment g.obj --source-skeleton s.obj --avatar a.obj --target-skeleton t.obj [options] -o out.obj\n"
    "\n"
    "Fits a garment that was modelled on one body to another body, with no triangle through another.\n"
    "\n"
    "  --garment FILE          the garment, around the source skeleton\n"
    "  --source-skeleton FILE  skeleton of the body it was modelled on: joints as v, bones as l lines\n"
    "  --avatar FILE           the body to dress\n"
    "  --target-skeleton FILE  its skeleton: the same joints in the same order, the same bones in any order\n"
    "  -o, --output FILE       the garment on the avatar, in the avatar's space and unit\n"
    "\n"
    "  --source-avatar FILE    the body the garment was modelled on; the fit then aims at the looseness it had there\n"
    "  --skin-weights FILE     skin weights of the avatar: a text matrix, a row for each joint, a column for each vertex\n"
    "  --layer FILE            a garment that the avatar wears already, in the avatar's space; may be given several times\n"
    "  --no-fit FILE           garment vertices (from 0); faces with all corners listed are not drawn to the body\n"
    "  --pins FILE             garment vertices to hold, a line each: the vertex (from 0) alone goes with its bone, or the\n"
    "                          vertex and the x y z where it is to be; the same in all lines\n"
    "  --rigid FILE            groups of garment vertices (from 0) that stay rigid, such as buttons: a line for each\n"
    "  --fit-weight W          how tight (2); 0 switches the term off\n"
    "  --designed-clearance X  with --source-avatar: how much of the looseness it had there to aim at (1); 0 is tight\n"
    "  --offset D              clearance to aim at everywhere beside that, in the unit of the avatar (0)\n"
    "  --fit-distance D        with --source-avatar, without --no-fit: what was designed up to D away from it fits, what was\n"
    "                          twice as far hangs (0.1; the skeleton is 2 long); 0: the whole garment fits\n"
    "  --pin-weight W          stiffness of the pins (1000)\n"
    "  --surface-weight W      how strongly the design keeps its shape (1)\n"
    "  --curve-weight W        the same for its boundary curves: curvature and torsion (1)\n"
    "  --position-weight W     how strongly cuffs, hems and collars keep their place along their bones (10)\n"
    "  --barrier-weight W      stiffness of contacts (1e8)\n"
    "  --dhat D                distance at which contacts begin (0.002; the skeleton is 2 long)\n"
    "  --voxel D               resolution of the distance field (0.01; the skeleton is 2 long)\n"
    "  --tolerance X           the fit ends where what a step still promises is below this part of the objective (1e-3)\n"
    "  --printed-surface       the surface term as printed in the paper, which makes scaling cost something\n"
    "  --strict                refuse a garment that intersects itself, instead of letting those triangles off\n"
    "  --threads N             0: all cores (0)\n"
    "  --memory-limit MB       give up where more memory would be needed (no limit)\n"
    "  --output-avatar FILE    the avatar that was dressed, written as it was read\n"
    "  --distortion FILE       how much each triangle is distorted: a number a line, in the order of the faces and of the\n"
    "                          triangles of their fans; 0 where the garment is similar to its design\n"
    "  --report FILE           a JSON file with times, iterations, energies, distances, counts and diagnostics\n"
    "  --quiet                 no progress on standard output, no warnings\n"
    "  --help, --version\n"
    "\n"
    "OBJ files are read with 32-bit coordinates. The output is the garment's file with moved vertices: order, faces,\n"
    "UVs, groups and materials stay. Vertex normals are computed afresh; corners that shared one still share one, and\n"
    "the faces count them in the order of their first use. Polygons are fans when it comes to contacts.\n"
    "\n"
    "Exit: 0 with a verified result, 1 without one, 2 for a wrong command line, 128 + n when stopped by signal n\n"
    "(130 for Ctrl-C). Files appear whole or not at all.\n";

bool options_parse(Options *options, int count, char **words, Message *message) {
    memset(options, 0, sizeof *options);
    const struct {
        const char *name;
        const char **place;
        bool is_needed;
    } paths[] = {
        {"--garment", &options->garment, true},
        {"--source-skeleton", &options->source_skeleton, true},
        {"--avatar", &options->avatar, true},
        {"--target-skeleton", &options->target_skeleton, true},
        {"--output", &options->output, true},
        {"--source-avatar", &options->source_avatar, false},
        {"--skin-weights", &options->skin_weights, false},
        {"--no-fit", &options->no_fit, false},
        {"--pins", &options->pins, false},
        {"--rigid", &options->rigid, false},
        {"--output-avatar", &options->output_avatar, false},
        {"--report", &options->report, false},
        {"--distortion", &options->distortion, false},
    };
    const struct {
        const char *name;
        double *place;
        bool is_positive;
    } numbers[] = {
        {"--fit-weight", &options->fit_weight, false},
        {"--designed-clearance", &options->designed_clearance, false},
        {"--offset", &options->offset, false},
        {"--fit-distance", &options->fit_distance, false},
        {"--pin-weight", &options->pin_weight, true},
        {"--surface-weight", &options->surface_weight, false},
        {"--curve-weight", &options->curve_weight, false},
        {"--position-weight", &options->position_weight, false},
        {"--barrier-weight", &options->barrier_weight, true},
        {"--dhat", &options->dhat, true},
        {"--voxel", &options->voxel, true},
        {"--tolerance", &options->tolerance, true},
        {"--threads", &options->threads, false},
        {"--memory-limit", &options->memory_limit, true},
    };
    const struct {
        const char *name;
        bool *place;
    } flags[] = {
        {"--printed-surface", &options->printed_surface},
        {"--strict", &options->strict},
        {"--quiet", &options->quiet},
        {"--help", &options->help},
        {"-h", &options->help},
        {"--version", &options->version},
    };
    const size_t path_count = sizeof paths / sizeof *paths;
    const size_t number_count = sizeof numbers / sizeof *numbers;
    const size_t flag_count = sizeof flags / sizeof *flags;
    for (size_t k = 0; k < number_count; k++) {
        *numbers[k].place = -1.0;
    }
    options->layers = array_new((size_t)count, sizeof *options->layers);
    if (options->layers == NULL) {
        return fail(message, "the command line does not fit into memory");
    }
    for (int i = 1; i < count; i++) {
        const char *name = strcmp(words[i], "-o") == 0 ? "--output" : words[i];
        bool is_flag = false;
        for (size_t k = 0; k < flag_count; k++) {
            if (strcmp(name, flags[k].name) == 0) {
                *flags[k].place = true;
                is_flag = true;
            }
        }
        if (is_flag) {
            continue;
        }
        /* --name value or --name=value */
        const char *equals = strchr(name, '=');
        const size_t length = equals != NULL ? (size_t)(equals - name) : strlen(name);
        const bool is_layer = strlen("--layer") == length && strncmp(name, "--layer", length) == 0;
        const char **path = is_layer ? &options->layers[options->layer_count++] : NULL;
        double *number = NULL;
        bool is_positive = false;
        for (size_t k = 0; k < path_count; k++) {
            if (strlen(paths[k].name) == length && strncmp(name, paths[k].name, length) == 0) {
                path = paths[k].place;
            }
        }
        for (size_t k = 0; k < number_count; k++) {
            if (strlen(numbers[k].name) == length && strncmp(name, numbers[k].name, length) == 0) {
                number = numbers[k].place;
                is_positive = numbers[k].is_positive;
            }
        }
        if (path == NULL && number == NULL) {
            return fail(message, "there is no option '%s'; see retarget --help", words[i]);
        }
        const char *value = equals != NULL ? equals + 1 : i + 1 < count ? words[++i] : NULL;
        if (value == NULL || *value == '\0') {
            return fail(message, "option %.*s needs a value", (int)length, name);
        }
        if (path != NULL) {
            *path = value;
        } else {
            const Word word = {value, value + strlen(value)};
            if (!word_number(word, number) || *number < 0.0 || (is_positive && *number == 0.0)) {
                return fail(message, "option %.*s has '%s', which is not a number %s", (int)length, name, value,
                            is_positive ? "above 0" : "from 0");
            }
        }
    }
    if (options->help || options->version) {
        return true;
    }
    for (size_t k = 0; k < path_count; k++) {
        if (paths[k].is_needed && *paths[k].place == NULL) {
            return fail(message, "%s is missing; see retarget --help", paths[k].name);
        }
    }
    const char *outputs[] = {options->output, options->output_avatar, options->report, options->distortion};
    for (size_t a = 0; a < sizeof outputs / sizeof *outputs; a++) {
        for (size_t b = 0; b < a; b++) {
            if (outputs[a] != NULL && outputs[b] != NULL && strcmp(outputs[a], outputs[b]) == 0) {
                return fail(message, "%s is named for two different outputs", outputs[a]);
            }
        }
    }
    if (options->threads != -1.0 && (options->threads > 1024.0 || options->threads != (double)(uint32_t)options->threads)) {
        return fail(message, "option --threads must be a whole number up to 1024");
    }
    return true;
}

void options_free(Options *options) {
    free(options->layers);
    memset(options, 0, sizeof *options);
}
