// Text of the library.
using System.Text;

namespace Bespoke
{
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
}
