// What of NUnit the package's tests use, so that they can be compiled, and run without a runner.
using System;

namespace NUnit.Framework
{
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class TestAttribute : Attribute { }

    public sealed class AssertionException : Exception
    {
        public AssertionException(string message) : base(message) { }
    }

    public static class Assert
    {
        public static void AreEqual(object expected, object actual)
        {
            IsTrue(Equals(expected, actual), $"{actual}, expected {expected}");
        }

        public static void IsTrue(bool condition, string message)
        {
            if (!condition)
            {
                throw new AssertionException(message);
            }
        }

        public static void IsNull(object thing, string message)
        {
            IsTrue(thing == null, message);
        }
    }
}
