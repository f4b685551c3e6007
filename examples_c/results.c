#include "results.h"

#include <stdlib.h>
#include <string.h>

#include "follow.h"
#include "report.h"

typedef BespokeStatus (*ReadVertices)(const BespokeSession *, const BespokeBuffer *, size_t *);

bool results_check(const Options *options, Message *message) {
    const char *paths[] = {options->output, options->output_avatar, options->distortion,
                           options->report, options->keep_partial, options->partial_avatar,
                           options->joint_map, options->output_skin, options->output_rig,
                           options->output_covered};
    for (size_t k = 0; k < sizeof paths / sizeof *paths; k++) {
        if (paths[k] != NULL && !output_check(paths[k], message)) {
            return false;
        }
    }
    return true;
}

/* A mesh as the library has it now; `comment`, unless null, stands on top. */
static bool write_mesh(Output *output, const char *path, Session *session, const Obj *obj, ReadVertices read,
                       const float *normals, const char *comment) {
    float *positions = array_new(obj->vertex_count, 3 * sizeof(float));
    if (positions == NULL) {
        return fail(&session->message, "%s: the vertices do not fit into memory", path);
    }
    const BespokeBuffer buffer = {positions, obj->vertex_count, 0, BESPOKE_COMPONENT_F32};
    const bool good = session_good(session, read(session->handle, &buffer, NULL), NULL) &&
                      output_open(output, path, &session->message) &&
                      obj_write(obj, positions, normals, comment, output->file, &session->message) &&
                      output_finish(output, &session->message);
    free(positions);
    return good;
}

/* The garment; where that is asked for with its normals, turned. */
static bool write_garment(Output *output, const Options *options, Session *session, const Obj *obj) {
    float *normals = NULL;
    if (options->garment_normals && obj->normal_count > 0) {
        const size_t count = obj->normal_count + obj->vertex_count;
        normals = array_new(count, 3 * sizeof *normals);
        uint32_t *triangles = array_new(obj->triangle_count, 3 * sizeof *triangles);
        bool good = normals != NULL && triangles != NULL;
        if (!good) {
            fail(&session->message, "the vertex normals do not fit into memory");
        } else {
            obj_render_mesh(obj, triangles, normals);
            const BespokeView corners = view_of(triangles, obj->triangle_count, BESPOKE_COMPONENT_U32);
            const BespokeView designed = view_of(normals, count, BESPOKE_COMPONENT_F32);
            const BespokeBuffer turned = {normals, count, 0, BESPOKE_COMPONENT_F32};
            good = session_good(session,
                                bespoke_session_read_garment_normals(session->handle, &corners, &designed, NULL, &turned,
                                                                     NULL, NULL),
                                options->garment);
        }
        free(triangles);
        if (!good) {
            free(normals);
            return false;
        }
    }
    const bool good = write_mesh(output, options->output, session, obj, bespoke_session_read_garment_vertices, normals, NULL);
    free(normals);
    return good;
}

static bool write_distortion(Output *output, const char *path, Session *session, size_t count) {
    double *values = array_new(count, sizeof *values);
    if (values == NULL) {
        return fail(&session->message, "the distortion does not fit into memory");
    }
    const BespokeBuffer buffer = {values, count, 0, BESPOKE_COMPONENT_F64};
    bool good = session_good(session, bespoke_session_read_distortion(session->handle, &buffer, NULL), NULL) &&
                output_open(output, path, &session->message);
    if (good) {
        for (size_t k = 0; k < count; k++) {
            fprintf(output->file, "%.9g\n", values[k]);
        }
        good = output_finish(output, &session->message);
    }
    free(values);
    return good;
}

static bool write_report(Output *output, const char *path, const Session *session, const char *status, const char *said,
                         Message *message) {
    return output_open(output, path, message) && report_write(session, status, said, output->file, message) &&
           output_finish(output, message);
}

/* What hosts take at most. */
enum { INFLUENCES = 8 };

static bool write_skin(Output *output, const char *path, Session *session, size_t count) {
    uint32_t *joints = array_new(count, INFLUENCES * sizeof *joints);
    float *weights = array_new(count, INFLUENCES * sizeof *weights);
    bool good = joints != NULL && weights != NULL;
    if (!good) {
        fail(&session->message, "%s: the skin weights do not fit into memory", path);
    }
    good = good &&
           session_good(session,
                        bespoke_session_read_garment_skin_influences(session->handle, INFLUENCES, joints, weights, count,
                                                                     NULL),
                        NULL) &&
           output_open(output, path, &session->message);
    for (size_t v = 0; good && v < count; v++) {
        for (size_t k = 0; k < INFLUENCES && (k == 0 || weights[v * INFLUENCES + k] > 0.0f); k++) {
            fprintf(output->file, "%s%u %.9g", k > 0 ? " " : "", (unsigned)joints[v * INFLUENCES + k],
                    (double)weights[v * INFLUENCES + k]);
        }
        fprintf(output->file, "\n");
    }
    free(joints);
    free(weights);
    return good && output_finish(output, &session->message);
}

/* The target rig, and after its joints those that the garment brings along. Their names are those of the source rig. */
static bool write_rig(Output *output, const char *path, Session *session, const Rig *target, const Rig *source) {
    size_t count = 0;
    if (!session_good(session, bespoke_session_read_added_joints(session->handle, NULL, 0, &count), NULL)) {
        return false;
    }
    BespokeAddedJoint *added = calloc(count > 0 ? count : 1, sizeof *added);
    if (added == NULL) {
        return fail(&session->message, "%s: the joints do not fit into memory", path);
    }
    const bool good =
        session_good(session, bespoke_session_read_added_joints(session->handle, added, count, &count), NULL) &&
        output_open(output, path, &session->message);
    if (good) {
        for (size_t k = 0; k < target->count; k++) {
            rig_write_joint(output->file, target->joints[k].name, target->joints[k].parent, target->joints[k].bind);
        }
        for (size_t k = 0; k < count; k++) {
            const char *name = added[k].source < source->count ? source->joints[added[k].source].name : "";
            rig_write_joint(output->file, name, added[k].parent, added[k].bind);
        }
    }
    free(added);
    return good && output_finish(output, &session->message);
}

static bool write_covered(Output *output, const char *path, Session *session, const Options *options, size_t count) {
    uint32_t *triangles = array_new(count, sizeof *triangles);
    if (triangles == NULL) {
        return fail(&session->message, "%s: the triangles do not fit into memory", path);
    }
    size_t covered = 0;
    const bool good =
        session_good(session,
                     bespoke_session_read_covered_triangles(session->handle, BESPOKE_NO_LAYER, options->covered_margin,
                                                            options->covered_openness, triangles, count, &covered),
                     NULL) &&
        output_open(output, path, &session->message);
    for (size_t k = 0; good && k < covered && k < count; k++) {
        fprintf(output->file, "%u\n", (unsigned)triangles[k]);
    }
    free(triangles);
    return good && output_finish(output, &session->message);
}

bool results_write(Results *results, Session *session, const Inputs *inputs, const Options *options, const char *status,
                   const char *said) {
    Output *outputs = results->outputs;
    results->further_count = follow_count(options);
    results->further = calloc(results->further_count > 0 ? results->further_count : 1, sizeof *results->further);
    if (results->further == NULL) {
        results->further_count = 0;
        return fail(&session->message, "the names of files do not fit into memory");
    }
    return write_garment(&outputs[0], options, session, &inputs->garment) &&
           follow_write(results->further, session, inputs, options) &&
           (options->output_avatar == NULL || write_mesh(&outputs[1], options->output_avatar, session, &inputs->avatar,
                                                         bespoke_session_read_avatar_vertices, NULL, NULL)) &&
           (options->distortion == NULL ||
            write_distortion(&outputs[2], options->distortion, session, inputs->garment.triangle_count)) &&
           (options->report == NULL ||
            write_report(&outputs[3], options->report, session, status, said, &session->message)) &&
           (options->output_skin == NULL ||
            write_skin(&outputs[4], options->output_skin, session, inputs->garment.vertex_count)) &&
           (options->output_covered == NULL ||
            write_covered(&outputs[6], options->output_covered, session, options, inputs->avatar.triangle_count)) &&
           (options->output_rig == NULL || write_rig(&outputs[5], options->output_rig, session, &inputs->target_rig, &inputs->source_rig));
}

bool results_commit(Results *results, Message *message) {
    for (size_t k = 0; k < RESULTS; k++) {
        if (!output_commit(&results->outputs[k], message)) {
            return false;
        }
    }
    for (size_t k = 0; k < results->further_count; k++) {
        if (!output_commit(&results->further[k], message)) {
            return false;
        }
    }
    return true;
}

void results_discard(Results *results) {
    for (size_t k = 0; k < RESULTS; k++) {
        output_discard(&results->outputs[k]);
    }
    for (size_t k = 0; k < results->further_count; k++) {
        output_discard(&results->further[k]);
    }
    free(results->further);
    results->further = NULL;
    results->further_count = 0;
}

/* A failure of a file has no status of the library. */
static const char *status_name(const Session *session) {
    return session->status == BESPOKE_STATUS_OK ? "FILE_ERROR" : bespoke_status_name(session->status);
}

static void leave_report(const Session *session, const char *path, FILE *file) {
    Output output;
    Message message;
    memset(&output, 0, sizeof output);
    if (!write_report(&output, path, session, status_name(session), session->message.text, &message) ||
        !output_commit(&output, &message)) {
        fprintf(file, "retarget: there is no report: %s\n", message.text);
    }
    output_discard(&output);
}

/* Both meshes or none. */
static void leave_partial(const Session *failed, const Inputs *inputs, const Options *options, FILE *file) {
    BespokeProgress progress = {.struct_size = sizeof progress};
    const bool has_moved = bespoke_session_read_progress(failed->handle, &progress) == BESPOKE_STATUS_OK &&
                           progress.stage != BESPOKE_STAGE_SETUP;
    if (!has_moved) {
        fputs("retarget: no partial garment: it ended before the avatar began to grow\n", file);
        return;
    }
    if (progress.stage == BESPOKE_STAGE_DONE) {
        return; /* verified, and nothing was wrong but a file */
    }
    char comment[192];
    snprintf(comment, sizeof comment, "partial: %s, t = %.4f (0: shrunk onto the skeleton, 1: full size), not verified",
             status_name(failed), progress.t);
    Session session = *failed; /* what fails here is not what the run failed of */
    Output garment, avatar;
    memset(&garment, 0, sizeof garment);
    memset(&avatar, 0, sizeof avatar);
    if (write_mesh(&garment, options->keep_partial, &session, &inputs->garment, bespoke_session_read_garment_vertices,
                   NULL, comment) &&
        write_mesh(&avatar, options->partial_avatar, &session, &inputs->avatar, bespoke_session_read_avatar_vertices,
                   NULL, comment) &&
        output_commit(&garment, &session.message) && output_commit(&avatar, &session.message)) {
        fprintf(file,
                "retarget: partial, not a result: %s is the garment, %s the avatar as far as it had grown (t = %.4f; 1 is "
                "its full size)\n",
                options->keep_partial, options->partial_avatar, progress.t);
    } else {
        fprintf(file, "retarget: no partial garment: %s\n", session.message.text);
    }
    output_discard(&garment);
    output_discard(&avatar);
}

void results_write_failure(Session *session, const Inputs *inputs, const Options *options, FILE *file) {
    if (options->report != NULL) {
        leave_report(session, options->report, file);
    }
    if (options->keep_partial != NULL) {
        leave_partial(session, inputs, options, file);
    }
}
