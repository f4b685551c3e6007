// The binding's structs and numbers are those of C: Layout LAYOUT_INC BESPOKE_H. It is compiled together with the
// binding's sources, whose structs nobody else can see. tests/capi/layout.h proves the same file to C.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;
using Bespoke;

internal static class Layout
{
    private static int Main(string[] paths)
    {
        string layout = File.ReadAllText(paths[0]);
        string header = File.ReadAllText(paths[1]);
        int structs = CheckStructs(layout);
        int values = CheckValues(layout);
        int functions = CheckFunctions(header);
        // No whole number, so not in the layout.
        Match off = Regex.Match(header, @"^#define BESPOKE_WEIGHT_OFF (\S+)$", RegexOptions.Multiline);
        Check.Same(Options.WeightOff, double.Parse(off.Groups[1].Value, CultureInfo.InvariantCulture), "WEIGHT_OFF");
        Console.WriteLine($"{structs} structs, {values} numbers, {functions} functions");
        return 0;
    }

    // Sizes and offsets as a pointer sees them and as the runtime would marshal them: the same, for they are blittable.
    private static unsafe int CheckStructs(string layout)
    {
        Dictionary<string, int> sizes = new Dictionary<string, int>
        {
            { "BespokeView", sizeof(NativeView) },
            { "BespokeBuffer", sizeof(NativeBuffer) },
            { "BespokeJoint", sizeof(NativeJoint) },
            { "BespokeAddedJoint", sizeof(NativeAddedJoint) },
            { "BespokeMappedJoint", sizeof(NativeMappedJoint) },
            { "BespokeWornPair", sizeof(NativeWornPair) },
            { "BespokePoseIntersections", sizeof(NativePoseIntersections) },
            { "BespokeCoordinateSystem", sizeof(NativeCoordinateSystem) },
            { "BespokeOptions", sizeof(NativeOptions) },
            { "BespokeIntersections", sizeof(NativeIntersections) },
            { "BespokeProgress", sizeof(NativeProgress) },
            { "BespokeStageReport", sizeof(NativeStageReport) },
            { "BespokeReport", sizeof(NativeReport) },
            { "BespokeEnergy", sizeof(NativeEnergy) },
            { "BespokeElement", sizeof(NativeElement) },
            { "BespokeDiagnostic", sizeof(NativeDiagnostic) },
        };
        MatchCollection listed = Regex.Matches(layout, @"^STRUCT\((\w+), (\d+)\)$", RegexOptions.Multiline);
        foreach (Match match in listed)
        {
            string name = match.Groups[1].Value;
            int size = int.Parse(match.Groups[2].Value);
            Type type = Struct(name);
            Check.That(sizes.ContainsKey(name), $"{name} has no sizeof here");
            Check.Same(sizes[name], size, $"sizeof {name}");
            Check.Same(Marshal.SizeOf(type), size, $"Marshal.SizeOf {name}");
            CheckFields(layout, name, type);
        }
        Check.Same(listed.Count, sizes.Count, "structs");
        return listed.Count;
    }

    private static void CheckFields(string layout, string name, Type type)
    {
        FieldInfo[] fields = type.GetFields(BindingFlags.Instance | BindingFlags.NonPublic | BindingFlags.Public);
        MatchCollection listed = Regex.Matches(
            layout, $@"^FIELD\({name}, (\w+), (\d+), (\d+)\)$", RegexOptions.Multiline);
        Check.That(listed.Count > 0, $"{name} has no fields in the layout");
        Check.Same(
            string.Join(" ", fields.Select(field => field.Name)),
            string.Join(" ", listed.Cast<Match>().Select(match => match.Groups[1].Value)),
            $"fields of {name}");
        foreach (Match match in listed)
        {
            string field = match.Groups[1].Value;
            FieldInfo info = fields.Single(candidate => candidate.Name == field);
            int offset = int.Parse(match.Groups[2].Value);
            int size = int.Parse(match.Groups[3].Value);
            Check.Same((int)Marshal.OffsetOf(type, field), offset, $"offset of {name}.{field}");
            Check.Same(SizeOf(info), size, $"size of {name}.{field}");
        }
    }

    private static int SizeOf(FieldInfo field)
    {
        FixedBufferAttribute array = field.GetCustomAttribute<FixedBufferAttribute>();
        if (array != null)
        {
            return array.Length * Marshal.SizeOf(array.ElementType);
        }
        Type type = field.FieldType;
        return type.IsPointer ? IntPtr.Size : Marshal.SizeOf(type.IsEnum ? Enum.GetUnderlyingType(type) : type);
    }

    private static Type Struct(string name)
    {
        Type type = typeof(Session).Assembly.GetType("Bespoke." + name.Replace("Bespoke", "Native"));
        Check.That(type != null, $"{name} is missing");
        return type;
    }

    // Every number with a name: members of enums and the constants.
    private static int CheckValues(string layout)
    {
        Dictionary<string, long> known = new Dictionary<string, long>
        {
            { "BESPOKE_ABI_VERSION", NativeConstants.AbiVersion },
            { "BESPOKE_NO_JOINT", NativeConstants.NoJoint },
            { "BESPOKE_NO_LAYER", NativeConstants.NoLayer },
            { "BESPOKE_TRANSFORM_SIZE", NativeConstants.TransformSize },
            { "BESPOKE_PART_NAME_SIZE", NativeConstants.PartNameSize },
            { "BESPOKE_MAX_TERMS", NativeConstants.MaxTerms },
            { "BESPOKE_ENERGY_NAME_SIZE", NativeConstants.EnergyNameSize },
            { "BESPOKE_MESSAGE_SIZE", NativeConstants.MessageSize },
            { "BESPOKE_MAX_ELEMENTS", NativeConstants.MaxElements },
        };
        // Precision is the part of Component that callers see.
        IEnumerable<Type> enums = typeof(Session).Assembly.GetTypes()
            .Where(type => type.IsEnum && type.Namespace == "Bespoke" && type != typeof(Precision));
        foreach (Type type in enums)
        {
            Check.Same(Enum.GetUnderlyingType(type), typeof(uint), $"{type.Name}'s numbers");
            foreach (object value in Enum.GetValues(type))
            {
                // What a struct of zeros means has no name in C.
                if (!value.Equals(Axis.Default))
                {
                    known.Add($"BESPOKE_{Upper(type.Name)}_{Upper(value.ToString())}", Convert.ToInt64(value));
                }
            }
        }
        MatchCollection listed = Regex.Matches(layout, @"^VALUE\((\w+), (-?\d+)\)$", RegexOptions.Multiline);
        foreach (Match match in listed)
        {
            string name = match.Groups[1].Value;
            Check.That(known.ContainsKey(name), $"{name} is missing");
            Check.Same(known[name], long.Parse(match.Groups[2].Value), name);
        }
        Check.Same(listed.Count, known.Count, "numbers with a name");
        return listed.Count;
    }

    // DiagnosticKind: DIAGNOSTIC_KIND; TJunctions: T_JUNCTIONS.
    private static string Upper(string name)
    {
        return Regex.Replace(name, "(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_").ToUpperInvariant();
    }

    // Every function of the header is declared, with as many parameters, as C calls it, and nothing is marshalled but a
    // SafeHandle to its pointer.
    private static int CheckFunctions(string header)
    {
        string code = Regex.Replace(header, "//.*", "");
        MatchCollection listed = Regex.Matches(code, @"\b(bespoke_\w+)\(([^)]*)\);");
        MethodInfo[] declared = typeof(Native)
            .GetMethods(BindingFlags.Static | BindingFlags.NonPublic | BindingFlags.DeclaredOnly);
        foreach (Match match in listed)
        {
            string name = match.Groups[1].Value;
            MethodInfo method = declared.SingleOrDefault(candidate => candidate.Name == name);
            Check.That(method != null, $"{name} is missing");
            string parameters = match.Groups[2].Value.Trim();
            int count = parameters == "void" ? 0 : parameters.Split(',').Length;
            Check.Same(method.GetParameters().Length, count, $"parameters of {name}");
            DllImportAttribute import = method.GetCustomAttribute<DllImportAttribute>();
            Check.Same(import.CallingConvention, CallingConvention.Cdecl, $"{name}: calling convention");
            Check.That(import.ExactSpelling && !import.SetLastError, $"{name}: exact spelling, no last error");
            Check.That(Crosses(method.ReturnType), $"{name} returns {method.ReturnType}");
            foreach (ParameterInfo parameter in method.GetParameters())
            {
                Type type = parameter.ParameterType;
                Check.That(Crosses(type) || type.IsSubclassOf(typeof(SafeHandle)), $"{name} takes {type}");
            }
        }
        Check.Same(declared.Length, listed.Count, "functions");
        return listed.Count;
    }

    private static bool Crosses(Type type)
    {
        return type == typeof(void) || type == typeof(uint) || type == typeof(double) || type == typeof(IntPtr) ||
            type == typeof(UIntPtr) || type.IsPointer || (type.IsEnum && Enum.GetUnderlyingType(type) == typeof(uint));
    }
}
