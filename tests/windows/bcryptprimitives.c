/* Wine 8 has no bcryptprimitives.dll, of which Rust's standard library asks for random keys. For tests only: on Windows
   the system's is there. */
#include <windows.h>
#include <ntsecapi.h>

__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE data, SIZE_T size) {
    return RtlGenRandom(data, (ULONG)size);
}
