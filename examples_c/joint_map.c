#include "joint_map.h"

#include <stdlib.h>

#include "output.h"

static const char *const reasons[] = {"nothing", "caller", "name", "structure", "order", "same-name", "ancestor"};

static const char *name_of(const Rig *rig, uint32_t joint) {
    const bool has_name = joint < rig->count && rig->joints[joint].name != NULL && rig->joints[joint].name[0] != '\0';
    return has_name ? rig->joints[joint].name : "-";
}

static void write_joints(const BespokeMappedJoint *joints, size_t count, const Inputs *inputs, FILE *file) {
    fprintf(file, "# joint, name -> joint, name: why, how sure (0 to 1), part of the body\n");
    for (uint32_t joint = 0; joint < count; joint++) {
        const BespokeMappedJoint *mapped = &joints[joint];
        fprintf(file, "%u %s -> ", (unsigned)joint, name_of(&inputs->source_rig, joint));
        if (mapped->target == BESPOKE_NO_JOINT) {
            fprintf(file, "none:");
        } else {
            fprintf(file, "%u %s:", (unsigned)mapped->target, name_of(&inputs->target_rig, mapped->target));
        }
        /* A later library may know more reasons than this program. */
        const bool is_known = mapped->reason < sizeof reasons / sizeof *reasons;
        fprintf(file, " %s, %.2f%s%s\n", is_known ? reasons[mapped->reason] : "other", mapped->confidence,
                mapped->part[0] != '\0' ? ", " : "", mapped->part);
    }
}

bool joint_map_write(Session *session, const Inputs *inputs, const char *path) {
    size_t count = 0;
    if (!session_good(session, bespoke_session_read_joint_map(session->handle, NULL, 0, &count), NULL)) {
        return false;
    }
    BespokeMappedJoint *joints = calloc(count > 0 ? count : 1, sizeof *joints);
    if (joints == NULL) {
        return fail(&session->message, "%s: the joint map does not fit into memory", path);
    }
    Output output = {0};
    const bool good =
        session_good(session, bespoke_session_read_joint_map(session->handle, joints, count, &count), NULL) &&
        output_open(&output, path, &session->message);
    if (good) {
        write_joints(joints, count, inputs, output.file);
    }
    const bool written = good && output_finish(&output, &session->message) && output_commit(&output, &session->message);
    output_discard(&output);
    free(joints);
    return written;
}
