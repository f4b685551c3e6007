// The same for C++: C linkage, and enums of the size that C gives them.
#include "bespoke.h"
#include "bespoke.h"
#include "layout.h"

BespokeStatus (*const create)(BespokeSession **) = bespoke_session_create;
static_assert(sizeof(BespokeStatus) == 4, "statuses are 32-bit");

int main() {
    BespokeSession *session = nullptr;
    return create(&session) == BESPOKE_STATUS_OK ? 0 : 1;
}
