// What a test says of what it sees. A failure is an exception, which ends the program with 1.
using System;
using System.Collections.Generic;
using Bespoke;

internal sealed class Failed : Exception
{
    public Failed(string message) : base(message)
    {
    }
}

internal static class Check
{
    public static void That(bool holds, string what)
    {
        if (!holds)
        {
            throw new Failed(what);
        }
    }

    public static void Same<T>(T found, T expected, string what)
    {
        That(EqualityComparer<T>.Default.Equals(found, expected), $"{what}: {found}, expected {expected}");
    }

    // The work throws just this type.
    public static T Throws<T>(Action work) where T : Exception
    {
        try
        {
            work();
        }
        catch (Exception thrown) when (thrown.GetType() == typeof(T))
        {
            return (T)thrown;
        }
        catch (Exception other)
        {
            throw new Failed($"expected {typeof(T).Name}, but thrown was {other}");
        }
        throw new Failed($"{typeof(T).Name} was not thrown");
    }

    // The library, or the binding for it, refuses the work with this status and a message that holds these words.
    public static void Refused(Status status, Action work, params string[] words)
    {
        BespokeException refusal = Throws<BespokeException>(work);
        Same(refusal.Status, status, refusal.Message);
        foreach (string word in words)
        {
            That(refusal.Message.Contains(word), $"the sentence \"{refusal.Message}\" does not hold \"{word}\"");
        }
    }

    // Two arrays hold the same bits.
    public static void SameBits(float[] found, float[] expected, string what)
    {
        Same(found.Length, expected.Length, $"{what}: numbers");
        for (int k = 0; k < found.Length; k++)
        {
            That(
                BitConverter.DoubleToInt64Bits(found[k]) == BitConverter.DoubleToInt64Bits(expected[k]),
                $"{what}: number {k} is {found[k]:G9}, expected {expected[k]:G9}");
        }
    }
}
