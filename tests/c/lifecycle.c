/* The life of sessions as a C program sees it: to the end, cancelled, refused, given up midway, and two at once. Made
   for the sanitizers and valgrind: every way of ending is walked, and everything is given back. */
#define _XOPEN_SOURCE 700

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bespoke.h"

#define CHECK(condition)                                                       \
    do {                                                                       \
        if (!(condition)) {                                                    \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);    \
            exit(1);                                                           \
        }                                                                      \
    } while (0)

enum { AROUND = 8, MAX_RINGS = 8, MAX_VERTICES = AROUND * MAX_RINGS, JOINTS = 3, BONES = 2 };

/* An open tube about the y axis. */
typedef struct Tube {
    float positions[MAX_VERTICES][3];
    uint32_t triangles[2 * MAX_VERTICES][3];
    BespokeView points;
    BespokeView corners;
} Tube;

static BespokeView view_of(const void *data, size_t count, uint32_t component) {
    const BespokeView view = {data, count, 0, component};
    return view;
}

static void tube_make(Tube *tube, double radius, double reach, int rings) {
    int count = 0;
    for (int k = 0; k < rings * AROUND; k++) {
        const double angle = 6.283185307179586 * (k % AROUND) / AROUND;
        tube->positions[k][0] = (float)(radius * sin(angle));
        tube->positions[k][1] = (float)(reach * (2.0 * (k / AROUND) / (rings - 1) - 1.0));
        tube->positions[k][2] = (float)(radius * cos(angle));
    }
    for (int k = 0; k < (rings - 1) * AROUND; k++) {
        const uint32_t ring = (uint32_t)(k / AROUND * AROUND);
        const uint32_t a = (uint32_t)k, b = ring + (uint32_t)(k + 1) % AROUND;
        const uint32_t quad[2][3] = {{a, b, b + AROUND}, {a, b + AROUND, a + AROUND}};
        memcpy(tube->triangles[count], quad, sizeof quad);
        count += 2;
    }
    tube->points = view_of(tube->positions, (size_t)(rings * AROUND), BESPOKE_COMPONENT_F32);
    tube->corners = view_of(tube->triangles, (size_t)count, BESPOKE_COMPONENT_U32);
}

static const double joints[JOINTS][3] = {{0, -1, 0}, {0, 0, 0}, {0, 1, 0}};
static const uint16_t bones[BONES][2] = {{0, 1}, {2, 1}};

/* A garment, a body that is thicker, and views of all that is set. */
typedef struct Scene {
    Tube garment;
    Tube body;
    BespokeView joints;
    BespokeView bones;
} Scene;

static void scene_make(Scene *scene) {
    tube_make(&scene->garment, 0.3, 0.5, 5);
    tube_make(&scene->body, 0.4, 0.9, MAX_RINGS);
    scene->joints = view_of(joints, JOINTS, BESPOKE_COMPONENT_F64);
    scene->bones = view_of(bones, BONES, BESPOKE_COMPONENT_U16);
}

static BespokeOptions coarse_options(void) {
    BespokeOptions options;
    memset(&options, 0, sizeof options);
    options.struct_size = sizeof options;
    options.threads = 2;
    options.voxel_size = 0.1;
    options.max_iterations = 200;
    return options;
}

/* The call was refused like this, with a sentence. */
static void refused(const BespokeSession *session, BespokeStatus got, BespokeStatus expected) {
    char sentence[512] = "";
    size_t needed = 0;
    CHECK(bespoke_session_last_message(session, sentence, sizeof sentence, &needed) == BESPOKE_STATUS_OK);
    if (got != expected) {
        fprintf(stderr, "%s instead of %s: %s\n", bespoke_status_name(got), bespoke_status_name(expected), sentence);
        exit(1);
    }
    CHECK(sentence[0] != '\0' && needed >= strlen(sentence) + 1);
}

static void accepted(const BespokeSession *session, BespokeStatus got) {
    if (got != BESPOKE_STATUS_OK) {
        char sentence[512] = "";
        bespoke_session_last_message(session, sentence, sizeof sentence, NULL);
        fprintf(stderr, "%s: %s\n", bespoke_status_name(got), sentence);
        exit(1);
    }
}

static BespokeSession *session_make(const Scene *scene) {
    BespokeSession *session = NULL;
    const BespokeOptions options = coarse_options();
    CHECK(bespoke_session_create(&session) == BESPOKE_STATUS_OK);
    accepted(session, bespoke_session_set_options(session, &options));
    accepted(session, bespoke_session_set_garment(session, &scene->garment.points, &scene->garment.corners));
    accepted(session, bespoke_session_set_target_avatar(session, &scene->body.points, &scene->body.corners));
    accepted(session, bespoke_session_set_source_skeleton(session, &scene->joints, &scene->bones));
    accepted(session, bespoke_session_set_target_skeleton(session, &scene->joints, &scene->bones));
    return session;
}

/* The garment's vertices, to be freed. */
static float *read_garment(const BespokeSession *session, size_t *count) {
    accepted(session, bespoke_session_read_garment_vertices(
                          session, &(BespokeBuffer){NULL, 0, 0, BESPOKE_COMPONENT_F32}, count));
    float *positions = malloc(*count * 3 * sizeof *positions);
    CHECK(positions != NULL);
    const BespokeBuffer room = {positions, *count, 0, BESPOKE_COMPONENT_F32};
    accepted(session, bespoke_session_read_garment_vertices(session, &room, NULL));
    for (size_t k = 0; k < 3 * *count; k++) {
        CHECK(isfinite(positions[k]));
    }
    return positions;
}

/* With everything that can be set. */
static void to_the_end(const Scene *scene) {
    BespokeSession *session = session_make(scene);
    const size_t vertices = scene->body.points.count;
    Tube mannequin;
    tube_make(&mannequin, 0.2, 0.9, MAX_RINGS);
    accepted(session, bespoke_session_set_source_avatar(session, &mannequin.points, &mannequin.corners));
    float *weights = calloc(JOINTS * vertices, sizeof *weights);
    uint16_t *influences = calloc(vertices, sizeof *influences);
    CHECK(weights != NULL && influences != NULL);
    for (size_t v = 0; v < vertices; v++) {
        influences[v] = (uint16_t)(v * JOINTS / vertices);
        weights[influences[v] * vertices + v] = 1.0f;
    }
    const BespokeView rows = view_of(weights, JOINTS, BESPOKE_COMPONENT_F32);
    accepted(session, bespoke_session_set_target_skin_weights(session, &rows, vertices));
    const BespokeView joint_view = view_of(influences, vertices, BESPOKE_COMPONENT_U16);
    for (size_t v = 0; v < vertices; v++) {
        weights[v] = 1.0f;
    }
    const BespokeView weight_view = view_of(weights, vertices, BESPOKE_COMPONENT_F32);
    accepted(session, bespoke_session_set_target_skin_influences(session, &joint_view, &weight_view, 1, JOINTS));
    const uint32_t hem[] = {0, 1, 2, 3};
    const BespokeView no_fit = view_of(hem, 4, BESPOKE_COMPONENT_U32);
    accepted(session, bespoke_session_set_no_fit_vertices(session, &no_fit));
    const BespokeView fit = view_of(weights, scene->garment.points.count, BESPOKE_COMPONENT_F32);
    accepted(session, bespoke_session_set_vertex_fit_weights(session, &fit));
    const BespokeCoordinateSystem space = {sizeof space, 0, 0, 0, 0.01, BESPOKE_WINDING_CLOCKWISE, 0};
    accepted(session, bespoke_session_set_source_coordinate_system(session, &space));
    accepted(session, bespoke_session_set_target_coordinate_system(session, &space));
    /* All of it was copied. */
    free(weights);
    free(influences);
    memset(&mannequin, 0, sizeof mannequin);

    accepted(session, bespoke_session_prepare(session));
    uint32_t stage = BESPOKE_STAGE_PREPARED;
    while (stage != BESPOKE_STAGE_DONE) {
        size_t count = 0;
        accepted(session, bespoke_session_step(session, 3, 0, &stage));
        free(read_garment(session, &count));
        CHECK(count == scene->garment.points.count);
    }
    BespokeIntersections found = {1, 1, 1};
    accepted(session, bespoke_session_verify(session, BESPOKE_COMPONENT_F32, &found));
    CHECK(found.garment_garment == 0 && found.garment_avatar == 0);
    BespokeReport report;
    memset(&report, 0, sizeof report);
    report.struct_size = sizeof report;
    accepted(session, bespoke_session_read_report(session, &report));
    CHECK(report.is_verified == 1 && report.garment_vertices == scene->garment.points.count);
    for (uint32_t k = 0; k < report.energy_count; k++) {
        BespokeEnergy energy = {.struct_size = sizeof energy};
        accepted(session, bespoke_session_read_energy(session, k, &energy));
        CHECK(strlen(energy.name) > 0 && isfinite(energy.value));
    }
    accepted(session, bespoke_session_destroy(session));
}

typedef struct Watcher {
    const BespokeControl *control;
    uint32_t stage;
} Watcher;

/* Cancels once the session has got to a stage. */
static void *cancel_at_stage(void *data) {
    const Watcher *watcher = data;
    BespokeProgress progress;
    memset(&progress, 0, sizeof progress);
    progress.struct_size = sizeof progress;
    do {
        CHECK(bespoke_control_read_progress(watcher->control, &progress) == BESPOKE_STATUS_OK);
    } while (progress.stage < watcher->stage);
    CHECK(bespoke_control_cancel(watcher->control) == BESPOKE_STATUS_OK);
    return NULL;
}

static void cancelled(const Scene *scene, uint32_t stage) {
    BespokeSession *session = session_make(scene);
    Watcher watcher = {NULL, stage};
    BespokeControl *control = NULL;
    pthread_t thread;
    CHECK(bespoke_session_create_control(session, &control) == BESPOKE_STATUS_OK);
    watcher.control = control;
    CHECK(pthread_create(&thread, NULL, cancel_at_stage, &watcher) == 0);
    /* The other thread may come too late for this small scene: then the run has ended well. */
    const BespokeStatus status = bespoke_session_run(session);
    CHECK(pthread_join(thread, NULL) == 0);
    if (status != BESPOKE_STATUS_OK) {
        refused(session, status, BESPOKE_STATUS_CANCELLED);
    }
    size_t count = 0;
    BespokeProgress progress;
    memset(&progress, 0, sizeof progress);
    progress.struct_size = sizeof progress;
    CHECK(bespoke_session_read_progress(session, &progress) == BESPOKE_STATUS_OK);
    if (progress.stage != BESPOKE_STAGE_SETUP) {
        free(read_garment(session, &count));
    }
    /* Asked for before it begins, a cancel is always in time. */
    accepted(session, bespoke_session_reset(session));
    CHECK(bespoke_session_cancel(session) == BESPOKE_STATUS_OK);
    refused(session, bespoke_session_run(session), BESPOKE_STATUS_CANCELLED);
    accepted(session, bespoke_session_reset(session));
    accepted(session, bespoke_session_run(session));
    free(read_garment(session, &count));
    accepted(session, bespoke_session_destroy(session));
    bespoke_control_destroy(control);
}

/* Every setter with arguments that it has to refuse, each with a sentence; and the session is as good as before. */
static void refusals(const Scene *scene) {
    BespokeSession *session = session_make(scene);
    const BespokeView *points = &scene->garment.points, *corners = &scene->garment.corners;
    typedef BespokeStatus (*SetPair)(BespokeSession *, const BespokeView *, const BespokeView *);
    const SetPair pairs[] = {bespoke_session_set_garment, bespoke_session_set_target_avatar,
                             bespoke_session_set_source_avatar, bespoke_session_set_source_skeleton,
                             bespoke_session_set_target_skeleton};
    BespokeView bad[6];
    for (size_t k = 0; k < 6; k++) {
        bad[k] = *points;
    }
    bad[0].data = NULL;
    bad[1].component = 0;
    bad[2].component = BESPOKE_COMPONENT_U32;
    bad[3].stride = 1;
    bad[4].count = SIZE_MAX;
    bad[5].stride = SIZE_MAX / 2;
    for (size_t p = 0; p < sizeof pairs / sizeof *pairs; p++) {
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
            refused(session, pairs[p](session, &bad[k], corners), BESPOKE_STATUS_INVALID_ARGUMENT);
        }
        refused(session, pairs[p](session, points, NULL), BESPOKE_STATUS_INVALID_ARGUMENT);
        refused(session, pairs[p](session, NULL, corners), BESPOKE_STATUS_INVALID_ARGUMENT);
        refused(session, pairs[p](session, points, points), BESPOKE_STATUS_INVALID_ARGUMENT);
        CHECK(pairs[p](NULL, points, corners) == BESPOKE_STATUS_INVALID_ARGUMENT);
        float values[9] = {0, 0, 0, 0, 1, 0, NAN, 0, 0};
        uint32_t indices[3] = {0, 1, 2};
        const BespokeView three = view_of(values, 3, BESPOKE_COMPONENT_F32);
        const BespokeView one = view_of(indices, 1, BESPOKE_COMPONENT_U32);
        const BespokeStatus kind = p < 3 ? BESPOKE_STATUS_INVALID_MESH : BESPOKE_STATUS_INVALID_SKELETON;
        refused(session, pairs[p](session, &three, &one), kind);
        values[6] = 1;
        indices[1] = 7;
        refused(session, pairs[p](session, &three, &one), kind);
        const BespokeView none = {NULL, 0, 0, BESPOKE_COMPONENT_F32};
        refused(session, pairs[p](session, &none, &one), kind);
    }
    const float weights[] = {1, 1, -1};
    const uint32_t numbers[] = {0, 1, 1000};
    const BespokeView negative = view_of(weights, 3, BESPOKE_COMPONENT_F32);
    const BespokeView beyond = view_of(numbers, 3, BESPOKE_COMPONENT_U32);
    const BespokeView no_rows = {NULL, 0, 0, BESPOKE_COMPONENT_F32};
    refused(session, bespoke_session_set_vertex_fit_weights(session, &negative), BESPOKE_STATUS_INVALID_WEIGHTS);
    refused(session, bespoke_session_set_vertex_fit_weights(session, NULL), BESPOKE_STATUS_INVALID_ARGUMENT);
    refused(session, bespoke_session_set_no_fit_vertices(session, &beyond), BESPOKE_STATUS_INVALID_ARGUMENT);
    refused(session, bespoke_session_set_target_skin_weights(session, &negative, 1), BESPOKE_STATUS_INVALID_WEIGHTS);
    refused(session, bespoke_session_set_target_skin_weights(session, &negative, SIZE_MAX),
            BESPOKE_STATUS_INVALID_ARGUMENT);
    refused(session, bespoke_session_set_target_skin_weights(session, &no_rows, SIZE_MAX / 16),
            BESPOKE_STATUS_INVALID_WEIGHTS);
    refused(session, bespoke_session_set_target_skin_influences(session, &beyond, &negative, 1, JOINTS),
            BESPOKE_STATUS_INVALID_WEIGHTS);
    BespokeCoordinateSystem space;
    memset(&space, 0, sizeof space);
    refused(session, bespoke_session_set_source_coordinate_system(session, &space), BESPOKE_STATUS_INVALID_ARGUMENT);
    space.struct_size = sizeof space;
    space.right = space.up = BESPOKE_AXIS_NEGATIVE_X;
    refused(session, bespoke_session_set_target_coordinate_system(session, &space), BESPOKE_STATUS_INVALID_ARGUMENT);
    BespokeOptions options = coarse_options();
    options.dhat = NAN;
    refused(session, bespoke_session_set_options(session, &options), BESPOKE_STATUS_INVALID_ARGUMENT);
    options.struct_size = 4;
    refused(session, bespoke_session_set_options(session, &options), BESPOKE_STATUS_INVALID_ARGUMENT);

    float small[3];
    const BespokeBuffer room = {small, 1, 0, BESPOKE_COMPONENT_F32};
    refused(session, bespoke_session_read_garment_vertices(session, &room, NULL), BESPOKE_STATUS_INVALID_STATE);
    refused(session, bespoke_session_step(session, 1, 0, NULL), BESPOKE_STATUS_INVALID_STATE);
    accepted(session, bespoke_session_prepare(session));
    refused(session, bespoke_session_prepare(session), BESPOKE_STATUS_INVALID_STATE);
    refused(session, bespoke_session_set_garment(session, points, corners), BESPOKE_STATUS_INVALID_STATE);
    refused(session, bespoke_session_read_garment_vertices(session, &room, NULL), BESPOKE_STATUS_INVALID_ARGUMENT);
    refused(session, bespoke_session_read_avatar_vertices(session, NULL, NULL), BESPOKE_STATUS_INVALID_ARGUMENT);
    refused(session, bespoke_session_verify(session, 0, NULL), BESPOKE_STATUS_INVALID_ARGUMENT);
    accepted(session, bespoke_session_run(session));
    refused(session, bespoke_session_run(session), BESPOKE_STATUS_INVALID_STATE);
    accepted(session, bespoke_session_destroy(session));
}

/* What prepare and run find out: weights for another mesh, a garment beside the skeleton, too few iterations. */
static void failures(const Scene *scene) {
    BespokeSession *session = session_make(scene);
    const float one = 1.0f;
    const BespokeView single = view_of(&one, 1, BESPOKE_COMPONENT_F32);
    accepted(session, bespoke_session_set_vertex_fit_weights(session, &single));
    refused(session, bespoke_session_run(session), BESPOKE_STATUS_INVALID_WEIGHTS);
    accepted(session, bespoke_session_destroy(session));

    session = session_make(scene);
    Tube beside = scene->garment;
    beside.points.data = beside.positions;
    for (size_t v = 0; v < beside.points.count; v++) {
        beside.positions[v][0] += 2.0f;
    }
    accepted(session, bespoke_session_set_garment(session, &beside.points, &scene->garment.corners));
    refused(session, bespoke_session_prepare(session), BESPOKE_STATUS_NOT_ENCLOSED);
    accepted(session, bespoke_session_set_garment(session, &scene->garment.points, &scene->garment.corners));
    BespokeOptions options = coarse_options();
    options.max_iterations = 1;
    accepted(session, bespoke_session_set_options(session, &options));
    refused(session, bespoke_session_run(session), BESPOKE_STATUS_INFLATION_STALLED);
    size_t count = 0;
    free(read_garment(session, &count));
    CHECK(count == scene->garment.points.count);
    accepted(session, bespoke_session_destroy(session));
}

/* Destroyed while the distance field is still built, and after a few steps. The control goes on. */
static void given_up(const Scene *scene) {
    BespokeProgress progress;
    memset(&progress, 0, sizeof progress);
    progress.struct_size = sizeof progress;
    for (uint32_t steps = 0; steps < 3; steps++) {
        BespokeSession *session = session_make(scene);
        BespokeControl *control = NULL;
        CHECK(bespoke_session_create_control(session, &control) == BESPOKE_STATUS_OK);
        accepted(session, bespoke_session_prepare(session));
        for (uint32_t k = 0; k < steps; k++) {
            accepted(session, bespoke_session_step(session, 1, 0, NULL));
        }
        accepted(session, bespoke_session_destroy(session));
        CHECK(bespoke_control_read_progress(control, &progress) == BESPOKE_STATUS_OK);
        CHECK(progress.stage == (steps == 0 ? BESPOKE_STAGE_PREPARED : BESPOKE_STAGE_INFLATE) || steps > 1);
        CHECK(bespoke_control_cancel(control) == BESPOKE_STATUS_OK);
        bespoke_control_destroy(control);
    }
    CHECK(bespoke_session_destroy(NULL) == BESPOKE_STATUS_OK);
    bespoke_control_destroy(NULL);
}

typedef struct Worker {
    const Scene *scene;
    float *result;
    size_t count;
} Worker;

static void *dress(void *data) {
    Worker *worker = data;
    BespokeSession *session = session_make(worker->scene);
    accepted(session, bespoke_session_run(session));
    worker->result = read_garment(session, &worker->count);
    accepted(session, bespoke_session_destroy(session));
    return NULL;
}

static void two_at_once(const Scene *scene) {
    pthread_t threads[2];
    Worker workers[2] = {{scene, NULL, 0}, {scene, NULL, 0}};
    for (size_t k = 0; k < 2; k++) {
        CHECK(pthread_create(&threads[k], NULL, dress, &workers[k]) == 0);
    }
    for (size_t k = 0; k < 2; k++) {
        CHECK(pthread_join(threads[k], NULL) == 0);
    }
    CHECK(workers[0].count == workers[1].count);
    CHECK(memcmp(workers[0].result, workers[1].result, workers[0].count * 3 * sizeof(float)) == 0);
    free(workers[0].result);
    free(workers[1].result);
}

int main(void) {
    static Scene scene;
    CHECK(bespoke_abi_version() == BESPOKE_ABI_VERSION);
    scene_make(&scene);
    to_the_end(&scene);
    cancelled(&scene, BESPOKE_STAGE_PREPARED);
    cancelled(&scene, BESPOKE_STAGE_FIT);
    refusals(&scene);
    failures(&scene);
    given_up(&scene);
    two_at_once(&scene);
    puts("lifecycle: all ends are clean");
    return 0;
}
