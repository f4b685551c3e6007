#include "session.h"

#include "system.h"

#include <stdio.h>
#include <string.h>

bool session_open(Session *session) {
    memset(session, 0, sizeof *session);
    session->start = system_seconds();
    if (bespoke_abi_version() != BESPOKE_ABI_VERSION) {
        return fail(&session->message, "the library that is installed (%s) is not the one this program was built for",
                    bespoke_version_text());
    }
    if (bespoke_session_create(&session->handle) != BESPOKE_STATUS_OK ||
        bespoke_session_create_control(session->handle, &session->control) != BESPOKE_STATUS_OK) {
        return fail(&session->message, "the library cannot start a session");
    }
    return true;
}

void session_close(Session *session) {
    bespoke_session_destroy(session->handle);
    bespoke_control_destroy(session->control);
    session->handle = NULL;
    session->control = NULL;
}

bool session_good(Session *session, BespokeStatus status, const char *path) {
    if (status == BESPOKE_STATUS_OK) {
        return true;
    }
    session->status = status;
    char said[768] = "";
    bespoke_session_last_message(session->handle, said, sizeof said, NULL);
    if (said[0] == '\0') {
        snprintf(said, sizeof said, "%s", bespoke_status_name(status));
    }
    return path != NULL ? fail(&session->message, "%s: %s", path, said) : fail(&session->message, "%s", said);
}

double session_seconds(const Session *session) {
    return system_seconds() - session->start;
}

BespokeView view_of(const void *data, size_t count, uint32_t component) {
    const BespokeView view = {data, count, 0, component};
    return view;
}
