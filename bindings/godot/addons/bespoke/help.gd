@tool
extends RefCounted
## What docs/troubleshooting.md says, which lies beside.

const FOLDER := "res://addons/bespoke/docs/"
const PAGE := "troubleshooting.md"
## The section about results that have a warning.
const WARNINGS := "results-with-a-warning"


## The section about a status, by its anchor; empty where nothing has failed.
static func of_status(status: int) -> String:
	if status == BespokeRetarget.STATUS_OK:
		return ""
	return BespokeRetarget.get_help_anchor(status).get_slice("#", 1)


## The section about a finding of a run that ended with a status; empty where there is nothing to read.
static func of_finding(one: Dictionary, status: int) -> String:
	if one.severity == BespokeRetarget.SEVERITY_ERROR and status != BespokeRetarget.STATUS_OK:
		return of_status(status)
	var kind := BespokeRetarget.get_constant_name("KIND", one.kind).replace("KIND_", "STATUS_")
	if ClassDB.class_has_integer_constant(&"BespokeRetarget", kind):
		return of_status(ClassDB.class_get_integer_constant(&"BespokeRetarget", kind))
	return WARNINGS if one.severity == BespokeRetarget.SEVERITY_WARNING else ""


## A section with marks for a RichTextLabel. Of the warnings, what is about this message.
static func text(anchor: String, message := "") -> String:
	var lines := PackedStringArray()
	var is_in := false
	for line in FileAccess.get_file_as_string(FOLDER + PAGE).split("\n"):
		if line.begins_with("## "):
			is_in = line.trim_prefix("## ").to_lower().replace(" ", "-") == anchor
		elif is_in:
			lines.append(line)
	var blocks := "\n".join(lines).strip_edges().split("\n\n")
	if anchor == WARNINGS:
		var about := _about(blocks, message)
		blocks = about if about else blocks.slice(0, 1)
	var section := "\n\n".join(blocks).replace("[", "[lb]")
	# Lines of a paragraph belong together; lists and quotes begin anew.
	section = RegEx.create_from_string("\\n(?=[^\\n>\\-0-9 ])|\\n +").sub(section.replace("\n\n", "\u2029"), " ", true)
	section = section.replace("\u2029", "\n\n").replace("> ", "")
	return RegEx.create_from_string("`([^`]*)`").sub(section, "[code]$1[/code]", true)


## The paragraphs that follow on the message, or on it and others.
static func _about(blocks: PackedStringArray, message: String) -> PackedStringArray:
	var found := PackedStringArray()
	var is_it := false
	for block in blocks:
		if block.begins_with("> "):
			if not found.is_empty():
				break
			is_it = is_it or _fits(block.trim_prefix("> `").trim_suffix("`"), message)
		elif is_it:
			found.append(block)
	return found


## Whether a message is one of a pattern, in which ... is anything.
static func _fits(pattern: String, message: String) -> bool:
	var at := 0
	for part in pattern.split("..."):
		var there := message.find(part, at)
		if there < 0:
			return false
		at = there + part.length()
	return true
