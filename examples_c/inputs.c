#include "inputs.h"

#include <stdlib.h>
#include <string.h>

#include "curves.h"
#include "follow.h"
#include "joint_map.h"
#include "numbers.h"
#include "parts.h"

/* Where none is told, the library has its own. */
static bool set_space(Session *session, const BespokeCoordinateSystem *space, const char *option,
                      BespokeStatus (*set)(BespokeSession *, const BespokeCoordinateSystem *)) {
    return space->struct_size == 0 || session_good(session, set(session->handle, space), option);
}

static bool set_mesh(Session *session, const Obj *obj, const char *path,
                     BespokeStatus (*set)(BespokeSession *, const BespokeView *, const BespokeView *)) {
    const BespokeView positions = view_of(obj->positions, obj->vertex_count, BESPOKE_COMPONENT_F32);
    const BespokeView triangles = view_of(obj->triangles, obj->triangle_count, BESPOKE_COMPONENT_U32);
    return session_good(session, set(session->handle, &positions, &triangles), path);
}

static bool set_skeleton(Session *session, const char *path,
                         BespokeStatus (*set)(BespokeSession *, const BespokeView *, const BespokeView *)) {
    Obj obj;
    if (!obj_read(&obj, path, &session->message)) {
        return false;
    }
    const BespokeView joints = view_of(obj.positions, obj.vertex_count, BESPOKE_COMPONENT_F32);
    const BespokeView bones = view_of(obj.segments, obj.segment_count, BESPOKE_COMPONENT_U32);
    const bool good = session_good(session, set(session->handle, &joints, &bones), path);
    obj_free(&obj);
    return good;
}

static bool set_rig(Session *session, Rig *rig, const char *path,
                    BespokeStatus (*set)(BespokeSession *, const BespokeJoint *, size_t)) {
    return rig_read(rig, path, &session->message) &&
           session_good(session, set(session->handle, rig->joints, rig->count), path);
}

static bool set_influences(Session *session, const char *path, size_t joint_count,
                           BespokeStatus (*set)(BespokeSession *, const BespokeView *, const BespokeView *, size_t,
                                                size_t)) {
    Influences influences;
    if (!influences_read(&influences, path, &session->message)) {
        return false;
    }
    const BespokeView joints = view_of(influences.joints, influences.count, BESPOKE_COMPONENT_U32);
    const BespokeView weights = view_of(influences.weights, influences.count, BESPOKE_COMPONENT_F32);
    const bool good =
        session_good(session, set(session->handle, &joints, &weights, influences.width, joint_count), path);
    influences_free(&influences);
    return good;
}

static bool set_joint_pairs(Session *session, const char *path) {
    List list;
    if (!list_read(&list, path, &session->message)) {
        return false;
    }
    bool good = true;
    for (size_t row = 0, begin = 0; good && row < list.rows; begin = list.ends[row++]) {
        if (list.ends[row] - begin != 2) {
            good = fail(&session->message, "%s: pair %zu has %zu numbers; a joint of either rig makes two", path, row + 1,
                        list.ends[row] - begin);
        }
    }
    if (good) {
        const BespokeView pairs = view_of(list.values, list.rows, BESPOKE_COMPONENT_U32);
        good = session_good(session, bespoke_session_set_joint_pairs(session->handle, &pairs), path);
    }
    list_free(&list);
    return good;
}

/* A mesh of which nothing is needed later. */
static bool set_further_mesh(Session *session, const char *path,
                             BespokeStatus (*set)(BespokeSession *, const BespokeView *, const BespokeView *)) {
    Obj obj;
    if (!obj_read(&obj, path, &session->message)) {
        return false;
    }
    const bool good = set_mesh(session, &obj, path, set);
    obj_free(&obj);
    return good;
}

static bool add_layers(Session *session, const Options *options) {
    for (size_t k = 0; k < options->layer_count; k++) {
        if (!set_further_mesh(session, options->layers[k], bespoke_session_add_layer)) {
            return false;
        }
    }
    return true;
}

static bool set_skin_weights(Session *session, const char *path, size_t vertex_count) {
    Matrix matrix;
    if (!matrix_read(&matrix, path, &session->message)) {
        return false;
    }
    bool good;
    if (matrix.columns != vertex_count) {
        good = fail(&session->message, "%s: has %zu columns, one for each vertex, but the avatar has %zu vertices",
                    path, matrix.columns, vertex_count);
    } else {
        const BespokeView rows = view_of(matrix.values, matrix.rows, BESPOKE_COMPONENT_F32);
        const BespokeStatus status =
            bespoke_session_set_target_skin_weights(session->handle, &rows, matrix.columns);
        good = session_good(session, status, path);
    }
    matrix_free(&matrix);
    return good;
}

static bool set_no_fit(Session *session, const char *path) {
    List list;
    if (!list_read(&list, path, &session->message)) {
        return false;
    }
    const BespokeView vertices = view_of(list.values, list.count, BESPOKE_COMPONENT_U32);
    const bool good = session_good(session, bespoke_session_set_no_fit_vertices(session->handle, &vertices), path);
    list_free(&list);
    return good;
}

static bool set_pins(Session *session, const char *path) {
    Matrix matrix;
    if (!matrix_read(&matrix, path, &session->message)) {
        return false;
    }
    uint32_t *vertices = array_new(matrix.rows, sizeof *vertices);
    float *places = array_new(matrix.rows, 3 * sizeof *places);
    bool good = vertices != NULL && places != NULL;
    if (!good) {
        fail(&session->message, "%s: does not fit into memory", path);
    } else if (matrix.columns != 1 && matrix.columns != 4) {
        good = fail(&session->message, "%s: has %zu numbers in a line; a pin is a vertex, or a vertex and x y z", path,
                    matrix.columns);
    }
    for (size_t k = 0; good && k < matrix.rows; k++) {
        const float *row = matrix.values + k * matrix.columns;
        if (!(row[0] >= 0.0f && row[0] <= 16777216.0f && row[0] == (float)(uint32_t)row[0])) {
            good = fail(&session->message, "%s: pin %zu is for vertex %g, which is not a whole number from 0", path,
                        k + 1, (double)row[0]);
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
            bespoke_session_set_pinned_vertices(session->handle, &pinned, matrix.columns == 4 ? &points : NULL);
        good = session_good(session, status, path);
    }
    free(vertices);
    free(places);
    matrix_free(&matrix);
    return good;
}

static bool add_rigid_groups(Session *session, const char *path) {
    List list;
    if (!list_read(&list, path, &session->message)) {
        return false;
    }
    bool good = true;
    for (size_t row = 0, begin = 0; good && row < list.rows; begin = list.ends[row++]) {
        const BespokeView vertices = view_of(list.values + begin, list.ends[row] - begin, BESPOKE_COMPONENT_U32);
        good = session_good(session, bespoke_session_add_rigid_group(session->handle, &vertices), path);
    }
    list_free(&list);
    return good;
}

bool inputs_set(Inputs *inputs, Session *session, const Options *options) {
    memset(inputs, 0, sizeof *inputs);
    return session_good(session, bespoke_session_set_options(session->handle, &options->library), NULL) &&
           set_space(session, &options->source_space, "--source-space", bespoke_session_set_source_coordinate_system) &&
           set_space(session, &options->target_space, "--target-space", bespoke_session_set_target_coordinate_system) &&
           obj_read(&inputs->garment, options->garment, &session->message) &&
           set_mesh(session, &inputs->garment, options->garment, bespoke_session_set_garment) &&
           (options->source_skeleton == NULL ||
            set_skeleton(session, options->source_skeleton, bespoke_session_set_source_skeleton)) &&
           (options->source_rig == NULL ||
            set_rig(session, &inputs->source_rig, options->source_rig, bespoke_session_set_source_rig)) &&
           obj_read(&inputs->avatar, options->avatar, &session->message) &&
           set_mesh(session, &inputs->avatar, options->avatar, bespoke_session_set_target_avatar) &&
           parts_set(session, &inputs->avatar, options) &&
           (options->target_skeleton == NULL ||
            set_skeleton(session, options->target_skeleton, bespoke_session_set_target_skeleton)) &&
           (options->target_rig == NULL ||
            set_rig(session, &inputs->target_rig, options->target_rig, bespoke_session_set_target_rig)) &&
           (options->source_avatar == NULL ||
            set_further_mesh(session, options->source_avatar, bespoke_session_set_source_avatar)) &&
           add_layers(session, options) &&
           (options->skin_weights == NULL ||
            set_skin_weights(session, options->skin_weights, inputs->avatar.vertex_count)) &&
           (options->target_skin == NULL ||
            set_influences(session, options->target_skin, inputs->target_rig.count,
                           bespoke_session_set_target_skin_influences)) &&
           (options->source_skin == NULL ||
            set_influences(session, options->source_skin, inputs->source_rig.count,
                           bespoke_session_set_source_skin_influences)) &&
           (options->garment_skin == NULL ||
            set_influences(session, options->garment_skin, inputs->source_rig.count,
                           bespoke_session_set_garment_skin_influences)) &&
           (options->joint_pairs == NULL || set_joint_pairs(session, options->joint_pairs)) &&
           (options->joint_map == NULL || joint_map_write(session, inputs, options->joint_map)) &&
           (options->no_fit == NULL || set_no_fit(session, options->no_fit)) &&
           (options->pins == NULL || set_pins(session, options->pins)) &&
           (options->rigid == NULL || add_rigid_groups(session, options->rigid)) &&
           (options->curves == NULL || curves_add(session, options->curves)) && follow_set(session, inputs, options);
}

void inputs_free(Inputs *inputs) {
    obj_free(&inputs->garment);
    obj_free(&inputs->avatar);
    for (size_t k = 0; k < inputs->follower_count; k++) {
        obj_free(&inputs->followers[k]);
    }
    free(inputs->followers);
    rig_free(&inputs->source_rig);
    rig_free(&inputs->target_rig);
}
