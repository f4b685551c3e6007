#include "space.h"

#include <string.h>

/* x, +x, -x and so on; 0 for what is no axis. */
static uint32_t axis_of(Word word) {
    const bool is_negative = *word.begin == '-';
    const char *letter = word.begin + (is_negative || *word.begin == '+' ? 1 : 0);
    if (word.end != letter + 1 || *letter < 'x' || *letter > 'z') {
        return 0;
    }
    return (uint32_t)BESPOKE_AXIS_POSITIVE_X + 2 * (uint32_t)(*letter - 'x') + (is_negative ? 1 : 0);
}

bool space_read(BespokeCoordinateSystem *space, const char *option, const char *value, Message *message) {
    uint32_t *const axes[] = {&space->right, &space->up, &space->forward};
    size_t axis_count = 0;
    memset(space, 0, sizeof *space);
    space->struct_size = sizeof *space;
    for (const char *begin = value;;) {
        const Word word = {begin, begin + strcspn(begin, ",")};
        double unit;
        if (axis_count < 3) {
            *axes[axis_count] = axis_of(word);
            if (*axes[axis_count++] == 0) {
                return fail(message, "option %s has '%s'; it begins with three axes (right, up, forward), as in -x,y,z",
                            option, value);
            }
        } else if (word_is(word, "trusted")) {
            space->trusted = 1;
        } else if (space->metres_per_unit == 0.0 && word_number(word, &unit) && unit > 0.0) {
            space->metres_per_unit = unit;
        } else {
            return fail(message, "option %s has '%.*s' after the axes, which is neither metres a unit nor 'trusted'",
                        option, (int)(word.end - word.begin), word.begin);
        }
        if (*word.end == '\0') {
            break;
        }
        begin = word.end + 1;
    }
    return axis_count == 3 || fail(message, "option %s has '%s'; it needs three axes (right, up, forward), as in -x,y,z",
                                   option, value);
}
