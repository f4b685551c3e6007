/* The header stands alone, twice included, and what it declares has the C types that a program expects. */
#include "bespoke.h"
#include "bespoke.h"
#include "layout.h"

BespokeStatus (*const create)(BespokeSession **) = bespoke_session_create;
BespokeStatus (*const step)(BespokeSession *, uint32_t, uint32_t, uint32_t *) = bespoke_session_step;
const uint32_t abi = BESPOKE_ABI_VERSION;
const BespokeOptions defaults = {.struct_size = sizeof(BespokeOptions), .fit_weight = BESPOKE_WEIGHT_OFF};
const BespokeView view = {.component = BESPOKE_COMPONENT_F32};

typedef char status_has_32_bits[sizeof(BespokeStatus) == 4 ? 1 : -1];
