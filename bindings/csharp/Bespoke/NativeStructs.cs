// The structs of bespoke.h, field by field. They hold numbers only, so that a pointer to one is all that crosses; that
// each lies as in C is pinned by tests/csharp/Layout.cs. Fields are named as in C.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Bespoke
{
    internal static class NativeConstants
    {
        internal const uint AbiVersion = 1;
        internal const double WeightOff = -1.0;
        internal const int MaxTerms = 12;
        internal const int EnergyNameSize = 32;
        internal const int SentenceSize = 512;
        internal const int MaxElements = 4;
    }

    internal static unsafe class Utf8
    {
        // The text before the first zero byte, of at most `size` bytes.
        internal static string Read(byte* text, int size)
        {
            int length = 0;
            while (length < size && text[length] != 0)
            {
                length++;
            }
            return Encoding.UTF8.GetString(text, length);
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeView
    {
        internal void* data;
        internal UIntPtr count;
        internal UIntPtr stride;
        internal Component component;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeBuffer
    {
        internal void* data;
        internal UIntPtr capacity;
        internal UIntPtr stride;
        internal Component component;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeSpace
    {
        internal uint struct_size;
        internal Axis right;
        internal Axis up;
        internal Axis forward;
        internal double metres_per_unit;
        internal Winding winding;
        internal uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeOptions
    {
        internal uint struct_size;
        internal uint threads;
        internal double fit_weight;
        internal double designed_clearance;
        internal double surface_weight;
        internal double curvature_weight;
        internal double torsion_weight;
        internal double position_weight;
        internal double barrier_weight;
        internal double dhat;
        internal double inflation_dhat;
        internal double inflation_barrier_weight;
        internal double voxel;
        internal double separation_floor;
        internal double tolerance;
        internal uint max_iterations;
        internal SurfaceForm surface_form;
        internal ulong memory_limit;
        internal uint strict;
        internal uint reserved;
        internal double offset;
        internal double fit_distance;
        internal double pin_weight;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeIntersections
    {
        internal ulong garment_garment;
        internal ulong since_start;
        internal ulong garment_avatar;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeProgress
    {
        internal uint struct_size;
        internal Stage stage;
        internal uint iteration;
        internal uint energy_count;
        internal double t;
        internal double energy;
        internal double gradient_norm;
        internal double min_distance;
        internal ulong active_contacts;
        internal double prepare_seconds;
        internal double inflate_seconds;
        internal double fit_seconds;
        internal double verify_seconds;
        internal fixed double energies[NativeConstants.MaxTerms];
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeWork
    {
        internal double seconds;
        internal uint iterations;
        internal uint factorisations;
        internal uint symbolic_factorisations;
        internal uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeReport
    {
        internal uint struct_size;
        internal uint threads;
        internal NativeWork prepare;
        internal NativeWork inflate;
        internal NativeWork fit;
        internal double verify_seconds;
        internal double field_seconds;
        internal double t;
        internal double gradient_norm;
        internal double garment_distance;
        internal double avatar_distance;
        internal ulong active_contacts;
        internal ulong garment_intersections;
        internal ulong avatar_intersections;
        internal ulong garment_vertices;
        internal ulong garment_triangles;
        internal ulong avatar_vertices;
        internal ulong avatar_triangles;
        internal ulong subdivided_avatar_vertices;
        internal ulong subdivided_avatar_triangles;
        internal double separation_floor;
        internal uint is_verified;
        internal uint is_converged;
        internal uint energy_count;
        internal uint reserved;
        internal ulong memory_bytes;
        internal ulong garment_intersections_at_start;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeEnergy
    {
        internal fixed byte name[NativeConstants.EnergyNameSize];
        internal double value;
        internal double weight;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeElement
    {
        internal Subject subject;
        internal ElementKind kind;
        internal uint index;
    }

    // C's array of BESPOKE_MAX_ELEMENTS, for which C# has no fixed buffer.
    [StructLayout(LayoutKind.Sequential)]
    internal struct NativeElements
    {
        internal NativeElement first;
        internal NativeElement second;
        internal NativeElement third;
        internal NativeElement fourth;
    }

    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeDiagnostic
    {
        internal DiagnosticKind kind;
        internal Severity severity;
        internal uint element_count;
        internal NativeElements elements;
        internal uint reserved;
        internal double distance;
        internal fixed byte sentence[NativeConstants.SentenceSize];
    }
}
