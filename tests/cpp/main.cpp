/* All tests of bespoke.hpp in one program, so that it is proven to go into several objects of one. With an argument, a
   mistake that has to end the program. */
#include "check.hpp"

int main(int count, char **arguments) {
    if (count > 1) {
        mistake(arguments[1]);
        return 0;
    }
    views();
    results();
    inputs();
    rigs();
    follow();
    sessions();
    stops();
    std::puts("all good");
    return 0;
}
