// 4 x 4 transforms, 16 numbers, column after column, as Unity's Matrix4x4 counts them.
using System;

namespace Bespoke.Unity
{
    /// <summary>
    /// Affine transforms of 16 numbers, column after column: numbers 12 to 14 (from 0) are the place, the last row is 0, 0, 0, 1.
    /// </summary>
    public static class Transform4
    {
        /// <summary>One that changes nothing.</summary>
        /// <returns>16 new numbers.</returns>
        public static double[] Identity()
        {
            return new double[] { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
        }

        /// <summary>First <paramref name="b"/>, then <paramref name="a"/>.</summary>
        /// <param name="a">16 numbers.</param>
        /// <param name="b">16 numbers.</param>
        /// <returns>16 new numbers.</returns>
        public static double[] Multiply(double[] a, double[] b)
        {
            double[] product = new double[16];
            for (int column = 0; column < 4; column++)
            {
                for (int row = 0; row < 4; row++)
                {
                    double sum = 0;
                    for (int k = 0; k < 4; k++)
                    {
                        sum += a[4 * k + row] * b[4 * column + k];
                    }
                    product[4 * column + row] = sum;
                }
            }
            return product;
        }

        /// <summary>The way back.</summary>
        /// <param name="m">16 numbers.</param>
        /// <returns>16 new numbers; null where there is no way back, as where a scale is 0.</returns>
        public static double[] Inverse(double[] m)
        {
            double[] cross =
            {
                m[5] * m[10] - m[6] * m[9], m[6] * m[8] - m[4] * m[10], m[4] * m[9] - m[5] * m[8],
                m[9] * m[2] - m[10] * m[1], m[10] * m[0] - m[8] * m[2], m[8] * m[1] - m[9] * m[0],
                m[1] * m[6] - m[2] * m[5], m[2] * m[4] - m[0] * m[6], m[0] * m[5] - m[1] * m[4],
            };
            double determinant = m[0] * cross[0] + m[1] * cross[1] + m[2] * cross[2];
            // Of a scale of a millionth in all directions it is 1e-18; what is not finite fails as well.
            if (!(Math.Abs(determinant) > 1e-30) || double.IsInfinity(determinant))
            {
                return null;
            }
            double[] inverse = Identity();
            for (int column = 0; column < 3; column++)
            {
                for (int row = 0; row < 3; row++)
                {
                    inverse[4 * column + row] = cross[3 * row + column] / determinant;
                }
            }
            for (int row = 0; row < 3; row++)
            {
                inverse[12 + row] = -(inverse[row] * m[12] + inverse[4 + row] * m[13] + inverse[8 + row] * m[14]);
            }
            return inverse;
        }

        /// <summary>Whether it moves nothing by more than rounding does.</summary>
        /// <param name="m">16 numbers.</param>
        /// <param name="tolerance">The largest difference of a number.</param>
        /// <returns>Whether it is so.</returns>
        public static bool IsIdentity(double[] m, double tolerance = 1e-5)
        {
            for (int k = 0; k < 16; k++)
            {
                if (!(Math.Abs(m[k] - (k % 5 == 0 ? 1 : 0)) <= tolerance))
                {
                    return false;
                }
            }
            return true;
        }

        /// <summary>Points, or with <paramref name="place"/> 0 directions, where the transform takes them.</summary>
        /// <param name="m">16 numbers.</param>
        /// <param name="points">x, y, z of each.</param>
        /// <param name="place">1 for points, 0 for directions.</param>
        /// <returns>As many new numbers.</returns>
        public static float[] Apply(double[] m, float[] points, double place = 1)
        {
            float[] moved = new float[points.Length];
            for (int k = 0; k + 2 < points.Length; k += 3)
            {
                for (int row = 0; row < 3; row++)
                {
                    moved[k + row] = (float)(m[row] * points[k] + m[4 + row] * points[k + 1] + m[8 + row] * points[k + 2]
                        + place * m[12 + row]);
                }
            }
            return moved;
        }
    }
}
