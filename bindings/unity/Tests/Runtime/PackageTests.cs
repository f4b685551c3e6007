// For Unity's test runner: the library is found, has the binding's interface, and dresses a tube.
using System;
using NUnit.Framework;

namespace Bespoke.Unity.Tests
{
    /// <summary>What only the engine can tell: whether it finds the library, and loads it.</summary>
    public sealed class PackageTests
    {
        /// <summary>The plugin that was imported is the one that the binding was written for.</summary>
        [Test]
        public void TheLibraryIsFound()
        {
            Assert.AreEqual(Library.AbiVersion, Library.LoadedAbiVersion);
        }

        /// <summary>A narrow tube widens over a thicker one.</summary>
        [Test]
        public void ATubeIsDressed()
        {
            FittingTask task = new FittingTask { Target = new Figure(Bones(), Tube("body", 0.2f, 0.9f)) };
            task.Garments.Add(new Figure(Bones(), Tube("sleeve", 0.15f, 0.5f)));
            Fitting run = new Fitting(task);
            run.Start().Wait();
            Assert.IsNull(run.Defect, $"{run.Defect}");
            Assert.AreEqual(1, run.Outcomes.Count);
            Assert.IsNull(run.Outcomes[0].Failure, $"{run.Outcomes[0].Failure}");
            Assert.AreEqual(0L, run.Outcomes[0].Intersections);
            float[] positions = run.Outcomes[0].Positions;
            for (int k = 0; k < positions.Length; k += 3)
            {
                double radius = Math.Sqrt(positions[k] * positions[k] + positions[k + 2] * (double)positions[k + 2]);
                Assert.IsTrue(radius > 0.19, $"vertex {k / 3} is {radius} from the axis");
            }
        }

        private static FigureJoint[] Bones()
        {
            FigureJoint[] joints = new FigureJoint[3];
            for (int k = 0; k < joints.Length; k++)
            {
                joints[k] = new FigureJoint { Name = "bone " + k, Parent = k - 1 };
                joints[k].ToWorld[13] = k - 1;
            }
            return joints;
        }

        private static SkinnedPart Tube(string name, float radius, float half)
        {
            const int Around = 16, Rings = 13;
            SkinnedPart tube = new SkinnedPart
            {
                Name = name, Positions = new float[3 * Around * Rings], Triangles = new int[6 * Around * (Rings - 1)],
                BonesPerVertex = new byte[Around * Rings], BoneIndices = new int[Around * Rings],
                BoneWeights = new float[Around * Rings], Joints = new[] { 0, 1, 2 }, BindPoses = new double[3][],
            };
            for (int k = 0; k < 3; k++)
            {
                tube.BindPoses[k] = Transform4.Inverse(Bones()[k].ToWorld);
            }
            for (int vertex = 0; vertex < Around * Rings; vertex++)
            {
                double angle = 2 * Math.PI * (vertex % Around) / Around;
                float y = half * (2f * (vertex / Around) / (Rings - 1) - 1);
                tube.Positions[3 * vertex] = radius * (float)Math.Cos(angle);
                tube.Positions[3 * vertex + 1] = y;
                tube.Positions[3 * vertex + 2] = radius * (float)Math.Sin(angle);
                tube.BonesPerVertex[vertex] = 1;
                tube.BoneIndices[vertex] = y < 0 ? 0 : 1;
                tube.BoneWeights[vertex] = 1;
            }
            for (int ring = 0, next = 0; ring < Rings - 1; ring++)
            {
                for (int k = 0; k < Around; k++)
                {
                    int a = ring * Around + k, b = ring * Around + (k + 1) % Around;
                    foreach (int corner in new[] { a, b, b + Around, a, b + Around, a + Around })
                    {
                        tube.Triangles[next++] = corner;
                    }
                }
            }
            return tube;
        }
    }
}
