# The comment at the head of bespoke.h as a comment that doxygen reads; the rest as it is.
#
# Its paragraphs begin with a word and a point ("Status.  ..."), and code is indented by three blanks.
BEGIN { head = 1; print "/** \\file"; print }
head && !/^\/\// { head = 0; print "*/" }
head {
    sub(/^\/\/ ?/, "")
    if (/^[A-Z][a-z]+\.  /) { sub(/\.  /, ".** "); $0 = "\n**" $0 }
    code = /^  / && (blank || code)
    blank = /^$/
    if (code) $0 = "    " $0
    print
    next
}
/^typedef uint32_t Bespoke/ { print "/// A number of the enum of this name." }
{ print }
