/* All sources in one object but views.cpp, which is compiled under the macros of windows.h. */
#include "main.cpp"
#include "results.cpp"
#include "inputs.cpp"
#include "rigs.cpp"
#include "sessions.cpp"
#include "stops.cpp"
#include "follow.cpp"
