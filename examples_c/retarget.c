/* retarget: dresses an avatar in a garment that was modelled on another body. Knows the library by its header only. */
#define _XOPEN_SOURCE 700

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "bespoke.h"
#include "diagnostics.h"
#include "obj.h"
#include "numbers.h"
#include "options.h"
#include "output.h"
#include "report.h"

/* The signal that asked to stop, and the session that it stops. */
static volatile sig_atomic_t stop_signal = 0;
static BespokeControl *volatile stop_control = NULL;

static void on_signal(int number) {
    stop_signal = number;
    if (stop_control != NULL) {
        bespoke_control_cancel(stop_control);
    }
}

static void watch_signal(int number) {
    struct sigaction action;
    /* Somebody who started us with the signal ignored (nohup) wants it ignored. */
    if (sigaction(number, NULL, &action) == 0 && action.sa_handler != SIG_IGN) {
        memset(&action, 0, sizeof action);
        action.sa_handler = on_signal;
        action.sa_flags = SA_RESTART;
        sigemptyset(&action.sa_mask);
        sigaction(number, &action, NULL);
    }
}

/* Garment, avatar, distortion, report. */
#define OUTPUTS 4

/* All that is open during a run. */
typedef struct Run {
    const Options *options;
    BespokeSession *session;
    BespokeControl *control;
    Obj garment;
    Obj avatar;
    Output outputs[OUTPUTS];
    double start;
    bool is_terminal;
    bool has_progress_line;
    int shown_stages;
    Message message;
} Run;

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Whether the call went well; if not, its sentence, with the file that it is about where there is one. */
static bool succeeded(Run *run, BespokeStatus status, const char *path) {
    if (status == BESPOKE_STATUS_OK) {
        return true;
    }
    char sentence[768] = "";
    bespoke_session_last_message(run->session, sentence, sizeof sentence, NULL);
    if (sentence[0] == '\0') {
        snprintf(sentence, sizeof sentence, "%s", bespoke_status_name(status));
    }
    return path != NULL ? fail(&run->message, "%s: %s", path, sentence) : fail(&run->message, "%s", sentence);
}

static BespokeView view_of(const void *data, size_t count, uint32_t component) {
    const BespokeView view = {data, count, 0, component};
    return view;
}

static bool set_mesh(Run *run, const Obj *obj, const char *path,
                     BespokeStatus (*set)(BespokeSession *, const BespokeView *, const BespokeView *)) {
    const BespokeView positions = view_of(obj->positions, obj->vertex_count, BESPOKE_COMPONENT_F32);
    const BespokeView triangles = view_of(obj->triangles, obj->triangle_count, BESPOKE_COMPONENT_U32);
    return succeeded(run, set(run->session, &positions, &triangles), path);
}

static bool set_skeleton(Run *run, const char *path,
                         BespokeStatus (*set)(BespokeSession *, const BespokeView *, const BespokeView *)) {
    Obj obj;
    if (!obj_read(&obj, path, &run->message)) {
        return false;
    }
    const BespokeView joints = view_of(obj.positions, obj.vertex_count, BESPOKE_COMPONENT_F32);
    const BespokeView bones = view_of(obj.segments, obj.segment_count, BESPOKE_COMPONENT_U32);
    const bool good = succeeded(run, set(run->session, &joints, &bones), path);
    obj_free(&obj);
    return good;
}

/* A mesh of which nothing is needed later. */
static bool set_further_mesh(Run *run, const char *path,
                             BespokeStatus (*set)(BespokeSession *, const BespokeView *, const BespokeView *)) {
    Obj obj;
    if (!obj_read(&obj, path, &run->message)) {
        return false;
    }
    const bool good = set_mesh(run, &obj, path, set);
    obj_free(&obj);
    return good;
}

static bool add_layers(Run *run) {
    const Options *options = run->options;
    for (size_t k = 0; k < options->layer_count; k++) {
        if (!set_further_mesh(run, options->layers[k], bespoke_session_add_layer)) {
            return false;
        }
    }
    return true;
}

static bool set_skin_weights(Run *run, const char *path) {
    Matrix matrix;
    if (!matrix_read(&matrix, path, &run->message)) {
        return false;
    }
    bool good;
    if (matrix.columns != run->avatar.vertex_count) {
        good = fail(&run->message, "%s: has %zu columns, one for each vertex, but the avatar has %zu vertices", path,
                    matrix.columns, run->avatar.vertex_count);
    } else {
        const BespokeView rows = view_of(matrix.values, matrix.rows, BESPOKE_COMPONENT_F32);
        good = succeeded(run, bespoke_session_set_target_skin_weights(run->session, &rows, matrix.columns), path);
    }
    matrix_free(&matrix);
    return good;
}

static bool set_no_fit(Run *run, const char *path) {
    List list;
    if (!list_read(&list, path, &run->message)) {
        return false;
    }
    const BespokeView vertices = view_of(list.values, list.count, BESPOKE_COMPONENT_U32);
    const bool good = succeeded(run, bespoke_session_set_no_fit_vertices(run->session, &vertices), path);
    list_free(&list);
    return good;
}

static bool set_pins(Run *run, const char *path) {
    Matrix matrix;
    if (!matrix_read(&matrix, path, &run->message)) {
        return false;
    }
    uint32_t *vertices = array_new(matrix.rows, sizeof *vertices);
    float *places = array_new(matrix.rows, 3 * sizeof *places);
    bool good = vertices != NULL && places != NULL;
    if (!good) {
        fail(&run->message, "%s: does not fit into memory", path);
    } else if (matrix.columns != 1 && matrix.columns != 4) {
        good = fail(&run->message, "%s: has %zu numbers in a line; a pin is a vertex, or a vertex and x y z", path,
                    matrix.columns);
    }
    for (size_t k = 0; good && k < matrix.rows; k++) {
        const float *row = matrix.values + k * matrix.columns;
        if (!(row[0] >= 0.0f && row[0] <= 16777216.0f && row[0] == (float)(uint32_t)row[0])) {
            good = fail(&run->message, "%s: pin %zu is for vertex %g, which is not a whole number from 0", path, k + 1,
                        (double)row[0]);
            break;
        }
        vertices[k] = (uint32_t)row[0];
        if (matrix.columns == 4) {
            memcpy(places + 3 * k, row + 1, 3 * sizeof *places);
        }
    }
    if (good) {
        const BespokeView pinned = view_of(vertices, matrix.rows, BESPOKE_COMPONENT_U32);
        const BespokeView points = view_of(places, matrix.rows, BESPOKE_COMPONENT_F32);
        const BespokeStatus status =
            bespoke_session_set_pinned_vertices(run->session, &pinned, matrix.columns == 4 ? &points : NULL);
        good = succeeded(run, status, path);
    }
    free(vertices);
    free(places);
    matrix_free(&matrix);
    return good;
}

static bool add_rigid_groups(Run *run, const char *path) {
    List list;
    if (!list_read(&list, path, &run->message)) {
        return false;
    }
    bool good = true;
    for (size_t row = 0, begin = 0; good && row < list.rows; begin = list.ends[row++]) {
        const BespokeView vertices = view_of(list.values + begin, list.ends[row] - begin, BESPOKE_COMPONENT_U32);
        good = succeeded(run, bespoke_session_add_rigid_group(run->session, &vertices), path);
    }
    list_free(&list);
    return good;
}

/* A weight as the library takes it: what was not given is the default, and 0 switches the term off. */
static double weight(double given) {
    return given < 0.0 ? 0.0 : given == 0.0 ? BESPOKE_WEIGHT_OFF : given;
}

/* A length or stiffness, which is never 0: what was not given is the default. */
static double magnitude(double given) {
    return given < 0.0 ? 0.0 : given;
}

static bool set_options(Run *run) {
    const Options *given = run->options;
    const BespokeOptions options = {
        .struct_size = sizeof options,
        .threads = given->threads > 0.0 ? (uint32_t)given->threads : 0,
        .fit_weight = weight(given->fit_weight),
        .designed_clearance = weight(given->designed_clearance),
        .offset = magnitude(given->offset),
        .fit_distance = weight(given->fit_distance),
        .pin_weight = magnitude(given->pin_weight),
        .surface_weight = weight(given->surface_weight),
        .curvature_weight = weight(given->curve_weight),
        .torsion_weight = weight(given->curve_weight),
        .position_weight = weight(given->position_weight),
        .barrier_weight = magnitude(given->barrier_weight),
        .dhat = magnitude(given->dhat),
        .voxel = magnitude(given->voxel),
        .tolerance = magnitude(given->tolerance),
        .memory_limit = given->memory_limit > 0.0 ? (uint64_t)(1e6 * given->memory_limit) : 0,
        .strict = given->strict ? 1 : 0,
        .surface_form = given->printed_surface ? BESPOKE_SURFACE_FORM_PRINTED : BESPOKE_SURFACE_FORM_SIMILARITY,
    };
    return succeeded(run, bespoke_session_set_options(run->session, &options), NULL);
}

static bool set_inputs(Run *run) {
    const Options *options = run->options;
    const char *outputs[OUTPUTS] = {options->output, options->output_avatar, options->distortion, options->report};
    for (size_t k = 0; k < OUTPUTS; k++) {
        if (outputs[k] != NULL && !output_check(outputs[k], &run->message)) {
            return false;
        }
    }
    return set_options(run) && obj_read(&run->garment, options->garment, &run->message) &&
           set_mesh(run, &run->garment, options->garment, bespoke_session_set_garment) &&
           set_skeleton(run, options->source_skeleton, bespoke_session_set_source_skeleton) &&
           obj_read(&run->avatar, options->avatar, &run->message) &&
           set_mesh(run, &run->avatar, options->avatar, bespoke_session_set_target_avatar) &&
           set_skeleton(run, options->target_skeleton, bespoke_session_set_target_skeleton) &&
           (options->source_avatar == NULL ||
            set_further_mesh(run, options->source_avatar, bespoke_session_set_source_avatar)) &&
           add_layers(run) &&
           (options->skin_weights == NULL || set_skin_weights(run, options->skin_weights)) &&
           (options->no_fit == NULL || set_no_fit(run, options->no_fit)) &&
           (options->pins == NULL || set_pins(run, options->pins)) &&
           (options->rigid == NULL || add_rigid_groups(run, options->rigid));
}

/* On a terminal one line that is written over and over, elsewhere one line for each stage once it has ended. */
static void show_progress(Run *run) {
    /* What goes on in the session, or goes on next. */
    static const char *const names[] = {"prepare", "inflate", "inflate", "fit", "verify", "done"};
    BespokeProgress progress = {.struct_size = sizeof progress};
    if (run->options->quiet || bespoke_session_read_progress(run->session, &progress) != BESPOKE_STATUS_OK ||
        progress.stage > BESPOKE_STAGE_DONE) {
        return;
    }
    if (run->is_terminal) {
        printf("\r%-8s t %.4f  iteration %-4u %7.1f s ", names[progress.stage], progress.t, (unsigned)progress.iteration,
               now() - run->start);
        run->has_progress_line = true;
    } else {
        const struct {
            const char *name;
            uint32_t next;
            double seconds;
        } stages[] = {
            {"prepare", BESPOKE_STAGE_PREPARED, progress.prepare_seconds},
            {"inflate", BESPOKE_STAGE_FIT, progress.inflate_seconds},
            {"fit", BESPOKE_STAGE_VERIFY, progress.fit_seconds},
            {"verify", BESPOKE_STAGE_DONE, progress.verify_seconds},
        };
        for (; run->shown_stages < 4 && progress.stage >= stages[run->shown_stages].next; run->shown_stages++) {
            printf("%s: %.2f s\n", stages[run->shown_stages].name, stages[run->shown_stages].seconds);
        }
    }
    fflush(stdout);
}

static void end_progress_line(Run *run) {
    if (run->has_progress_line) {
        putchar('\n');
        fflush(stdout);
        run->has_progress_line = false;
    }
}

static bool work(Run *run) {
    show_progress(run);
    if (!succeeded(run, bespoke_session_prepare(run->session), NULL)) {
        return false;
    }
    show_progress(run);
    for (uint32_t stage = BESPOKE_STAGE_PREPARED; stage != BESPOKE_STAGE_DONE; show_progress(run)) {
        if (!succeeded(run, bespoke_session_step(run->session, 0, 100, &stage), NULL)) {
            return false;
        }
    }
    return true;
}

typedef BespokeStatus (*ReadVertices)(const BespokeSession *, const BespokeBuffer *, size_t *);

static bool write_mesh(Run *run, Output *output, const Obj *obj, const char *path, ReadVertices read) {
    float *positions = array_new(obj->vertex_count, 3 * sizeof(float));
    if (positions == NULL) {
        return fail(&run->message, "the result does not fit into memory");
    }
    const BespokeBuffer buffer = {positions, obj->vertex_count, 0, BESPOKE_COMPONENT_F32};
    const bool good = succeeded(run, read(run->session, &buffer, NULL), NULL) && output_open(output, path, &run->message) &&
                      obj_write(obj, positions, output->file, &run->message) && output_finish(output, &run->message);
    free(positions);
    return good;
}

static bool write_distortion(Run *run, Output *output, const char *path) {
    const size_t count = run->garment.triangle_count;
    double *values = array_new(count, sizeof *values);
    if (values == NULL) {
        return fail(&run->message, "the distortion does not fit into memory");
    }
    const BespokeBuffer buffer = {values, count, 0, BESPOKE_COMPONENT_F64};
    bool good = succeeded(run, bespoke_session_read_distortion(run->session, &buffer, NULL), NULL) &&
                output_open(output, path, &run->message);
    if (good) {
        for (size_t k = 0; k < count; k++) {
            fprintf(output->file, "%.9g\n", values[k]);
        }
        good = output_finish(output, &run->message);
    }
    free(values);
    return good;
}

/* All files are whole under their other names before the first gets its own. */
static bool write_outputs(Run *run) {
    const Options *options = run->options;
    if (!write_mesh(run, &run->outputs[0], &run->garment, options->output, bespoke_session_read_garment_vertices)) {
        return false;
    }
    if (options->output_avatar != NULL && !write_mesh(run, &run->outputs[1], &run->avatar, options->output_avatar,
                                                      bespoke_session_read_avatar_vertices)) {
        return false;
    }
    if (options->distortion != NULL && !write_distortion(run, &run->outputs[2], options->distortion)) {
        return false;
    }
    if (options->report != NULL) {
        Output *output = &run->outputs[3];
        if (!output_open(output, options->report, &run->message) ||
            !report_write(run->session, now() - run->start, output->file, &run->message) ||
            !output_finish(output, &run->message)) {
            return false;
        }
    }
    if (stop_signal != 0) {
        return fail(&run->message, "stopped");
    }
    for (size_t k = 0; k < OUTPUTS; k++) {
        if (!output_commit(&run->outputs[k], &run->message)) {
            return false;
        }
    }
    return true;
}

static bool dress(Run *run) {
    if (bespoke_abi_version() != BESPOKE_ABI_VERSION) {
        return fail(&run->message, "the library that is installed (%s) is not the one this program was built for",
                    bespoke_version_text());
    }
    if (bespoke_session_create(&run->session) != BESPOKE_STATUS_OK ||
        bespoke_session_create_control(run->session, &run->control) != BESPOKE_STATUS_OK) {
        return fail(&run->message, "the library cannot start a session");
    }
    stop_control = run->control;
    if (stop_signal != 0) {
        bespoke_control_cancel(run->control);
    }
    const bool good = set_inputs(run) && work(run);
    end_progress_line(run);
    if (good && !run->options->quiet) {
        diagnostics_print(run->session, stderr);
    }
    return good && write_outputs(run);
}

int main(int count, char **words) {
    Options options;
    Run run;
    memset(&run, 0, sizeof run);
    run.options = &options;
    run.start = now();
    run.is_terminal = isatty(STDOUT_FILENO) != 0;
    if (!options_parse(&options, count, words, &run.message)) {
        options_free(&options);
        fprintf(stderr, "retarget: %s\n", run.message.text);
        return 2;
    }
    if (options.help || options.version) {
        if (options.help) {
            fputs(options_usage, stdout);
        } else {
            printf("retarget %s\n", bespoke_version_text());
        }
        options_free(&options);
        return 0;
    }
    watch_signal(SIGINT);
    watch_signal(SIGTERM);
    watch_signal(SIGHUP);
    /* A reader that went away and a limit on file sizes are errors of writing, with a sentence. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    const bool good = dress(&run);
    for (size_t k = 0; k < OUTPUTS; k++) {
        output_discard(&run.outputs[k]);
    }
    obj_free(&run.garment);
    obj_free(&run.avatar);
    bespoke_session_destroy(run.session);
    stop_control = NULL;
    bespoke_control_destroy(run.control);
    options_free(&options);
    if (good) {
        return 0;
    }
    if (stop_signal != 0) {
        fprintf(stderr, "retarget: stopped by %s; nothing was written\n", stop_signal == SIGINT ? "Ctrl-C" : "a signal");
        return 128 + stop_signal;
    }
    fprintf(stderr, "retarget: %s\n", run.message.text);
    return 1;
}
