// The functions of bespoke.h. All that crosses is blittable: numbers, pointers, and handles as their pointers.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    internal static unsafe class Native
    {
        // Where the library is linked into the program itself, as on iOS and consoles, there is no file to look for.
#if BESPOKE_STATIC || (UNITY_IOS && !UNITY_EDITOR)
        private const string Library = "__Internal";
#else
        private const string Library = "bespoke";
#endif
        private const CallingConvention C = CallingConvention.Cdecl;

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern byte* bespoke_status_name(uint status);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern uint bespoke_abi_version();

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern byte* bespoke_version_text();

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_create(IntPtr* session);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_destroy(IntPtr session);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_reset(SessionHandle session);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_last_message(
            SessionHandle session, byte* buffer, UIntPtr capacity, UIntPtr* needed);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_garment(
            SessionHandle session, NativeView* positions, NativeView* triangles);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_source_skeleton(
            SessionHandle session, NativeView* joints, NativeView* bones);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_target_avatar(
            SessionHandle session, NativeView* positions, NativeView* triangles);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_target_skeleton(
            SessionHandle session, NativeView* joints, NativeView* bones);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_source_avatar(
            SessionHandle session, NativeView* positions, NativeView* triangles);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_target_skin_weights(
            SessionHandle session, NativeView* rows, UIntPtr vertices);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_target_skin_influences(
            SessionHandle session, NativeView* joints, NativeView* weights, UIntPtr influences, UIntPtr jointCount);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_source_space(SessionHandle session, NativeSpace* space);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_target_space(SessionHandle session, NativeSpace* space);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_fit_weights(SessionHandle session, NativeView* weights);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_no_fit_vertices(SessionHandle session, NativeView* vertices);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_pinned_vertices(
            SessionHandle session, NativeView* vertices, NativeView* places);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_add_rigid_group(SessionHandle session, NativeView* vertices);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_clear_rigid_groups(SessionHandle session);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_add_layer(
            SessionHandle session, NativeView* positions, NativeView* triangles);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_clear_layers(SessionHandle session);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_set_options(SessionHandle session, NativeOptions* options);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_options_read_defaults(NativeOptions* options);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_prepare(SessionHandle session);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_step(
            SessionHandle session, uint maxIterations, uint maxMilliseconds, Stage* stage);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_run(SessionHandle session);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_verify(
            SessionHandle session, Component component, NativeIntersections* intersections);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_cancel(SessionHandle session);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_read_progress(SessionHandle session, NativeProgress* progress);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_create_control(SessionHandle session, IntPtr* control);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_control_cancel(ControlHandle control);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_control_read_progress(ControlHandle control, NativeProgress* progress);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern void bespoke_control_destroy(IntPtr control);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_read_garment_vertices(
            SessionHandle session, NativeBuffer* points, UIntPtr* count);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_read_avatar_vertices(
            SessionHandle session, NativeBuffer* points, UIntPtr* count);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_read_distortion(
            SessionHandle session, NativeBuffer* values, UIntPtr* count);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_read_report(SessionHandle session, NativeReport* report);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_read_energy(
            SessionHandle session, uint index, NativeEnergy* energy);

        [DllImport(Library, CallingConvention = C, ExactSpelling = true)]
        internal static extern Status bespoke_session_read_diagnostics(
            SessionHandle session, NativeDiagnostic* diagnostics, UIntPtr capacity, UIntPtr* count);
    }
}
