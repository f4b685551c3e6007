// How a surface has turned and grown: normals, tangents and blend shapes of what goes along with a garment.
using System;
using System.Collections.Generic;

namespace Bespoke.Unity
{
    /// <summary>For each vertex of a mesh, how the triangles around it have turned and grown.</summary>
    public sealed class Turns
    {
        private readonly int[] places;
        private readonly double[][] turns;
        private readonly double[] sizes;

        /// <summary>From one shape of a mesh to another one. Vertices in one place turn alike.</summary>
        /// <param name="triangles">Three vertices each.</param>
        /// <param name="before">x, y, z of each vertex.</param>
        /// <param name="after">The same, in the other shape.</param>
        public Turns(int[] triangles, float[] before, float[] after)
        {
            places = new int[before.Length / 3];
            Dictionary<string, int> known = new Dictionary<string, int>();
            for (int v = 0; v < places.Length; v++)
            {
                string place = $"{before[3 * v]:R} {before[3 * v + 1]:R} {before[3 * v + 2]:R}";
                if (!known.TryGetValue(place, out places[v]))
                {
                    places[v] = known.Count;
                    known.Add(place, places[v]);
                }
            }
            Sides was = new Sides(known.Count, places, triangles, before);
            Sides now = new Sides(known.Count, places, triangles, after);
            turns = new double[known.Count][];
            sizes = new double[known.Count];
            for (int place = 0; place < turns.Length; place++)
            {
                double[] from = was.Frame(place);
                double[] to = now.Frame(place);
                double size = Math.Sqrt(now.Areas[place] / was.Areas[place]);
                bool isKnown = from != null && to != null && size > 0 && !double.IsInfinity(size);
                sizes[place] = isKnown ? size : 1;
                turns[place] = isKnown ? Between(from, to) : new double[] { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
            }
        }

        /// <summary>Vectors of vertices, turned so.</summary>
        /// <param name="vectors">Three or four numbers each; a fourth stays.</param>
        /// <param name="width">How many.</param>
        /// <param name="grow">Whether they grow, as offsets do.</param>
        /// <returns>New ones; null for null.</returns>
        public float[] Turned(float[] vectors, int width, bool grow)
        {
            if (vectors == null)
            {
                return null;
            }
            float[] turned = (float[])vectors.Clone();
            for (int v = 0; v < vectors.Length / width; v++)
            {
                double[] turn = turns[places[v]];
                double size = grow ? sizes[places[v]] : 1;
                for (int row = 0; row < 3; row++)
                {
                    double sum = 0;
                    for (int column = 0; column < 3; column++)
                    {
                        sum += turn[3 * row + column] * vectors[width * v + column];
                    }
                    turned[width * v + row] = (float)(size * sum);
                }
            }
            return turned;
        }

        // From the axes of one frame, a row each, to those of another one.
        private static double[] Between(double[] from, double[] to)
        {
            double[] turn = new double[9];
            for (int row = 0; row < 3; row++)
            {
                for (int column = 0; column < 3; column++)
                {
                    for (int axis = 0; axis < 3; axis++)
                    {
                        turn[3 * row + column] += to[3 * axis + row] * from[3 * axis + column];
                    }
                }
            }
            return turn;
        }

        // The triangles around each place, in one shape.
        private sealed class Sides
        {
            public readonly double[] Areas;
            private readonly double[][] across;
            private readonly double[][] along;

            public Sides(int count, int[] places, int[] triangles, float[] points)
            {
                Areas = new double[count];
                across = new double[count][];
                along = new double[count][];
                for (int k = 0; k + 2 < triangles.Length; k += 3)
                {
                    double[] normal = Cross(
                        Edge(points, triangles[k], triangles[k + 1]), Edge(points, triangles[k], triangles[k + 2]));
                    for (int corner = 0; corner < 3; corner++)
                    {
                        int vertex = triangles[k + corner];
                        int place = places[vertex];
                        Areas[place] += Math.Sqrt(Dot(normal, normal));
                        across[place] = across[place] ?? new double[3];
                        for (int axis = 0; axis < 3; axis++)
                        {
                            across[place][axis] += normal[axis];
                        }
                        // By an edge, a turn around the normal is seen.
                        along[place] = along[place] ?? Edge(points, vertex, triangles[k + (corner + 1) % 3]);
                    }
                }
            }

            // The edge as far as it is perpendicular to the normal, what is perpendicular to both, and the normal; null: none.
            public double[] Frame(int place)
            {
                double[] normal = across[place] == null ? null : Unit(across[place]);
                if (normal == null)
                {
                    return null;
                }
                double share = Dot(along[place], normal);
                double[] side = new double[3];
                for (int axis = 0; axis < 3; axis++)
                {
                    side[axis] = along[place][axis] - share * normal[axis];
                }
                side = Unit(side);
                if (side == null)
                {
                    return null;
                }
                double[] other = Cross(normal, side);
                return new[]
                {
                    side[0], side[1], side[2], other[0], other[1], other[2], normal[0], normal[1], normal[2],
                };
            }

            private static double[] Edge(float[] points, int from, int to)
            {
                double[] edge = new double[3];
                for (int axis = 0; axis < 3; axis++)
                {
                    edge[axis] = (double)points[3 * to + axis] - points[3 * from + axis];
                }
                return edge;
            }

            private static double[] Cross(double[] a, double[] b)
            {
                return new[] { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
            }

            private static double Dot(double[] a, double[] b)
            {
                return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            }

            private static double[] Unit(double[] a)
            {
                double length = Math.Sqrt(Dot(a, a));
                return length > 1e-30 ? new[] { a[0] / length, a[1] / length, a[2] / length } : null;
            }
        }
    }
}
