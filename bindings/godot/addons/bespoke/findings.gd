@tool
extends VBoxContainer
## What the library has to say. One that is chosen is shown in the viewport, and its node is selected.

const Marks := preload("marks.gd")
## More triangles of one kind help nobody.
const MOST := 400
const ICONS := {
	BespokeRetarget.SEVERITY_NOTE: &"NodeInfo",
	BespokeRetarget.SEVERITY_WARNING: &"StatusWarning",
	BespokeRetarget.SEVERITY_ERROR: &"StatusError",
}

var list := ItemList.new()
var what_to_do := Button.new()
var marks: Array[MeshInstance3D] = []
var _title := Label.new()
var _text := Label.new()
var _help := AcceptDialog.new()
var _help_text := RichTextLabel.new()
var _findings: Array = []
var _status := 0


func _init() -> void:
	var row := HBoxContainer.new()
	_title.size_flags_horizontal = SIZE_EXPAND_FILL
	row.add_child(_title)
	what_to_do.text = "What to do"
	what_to_do.pressed.connect(_show_help)
	row.add_child(what_to_do)
	add_child(row)
	list.custom_minimum_size.y = 120
	list.item_selected.connect(_chosen)
	list.allow_reselect = true
	add_child(list)
	_text.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	add_child(_text)
	_help.title = "What to do"
	_help_text.bbcode_enabled = true
	_help_text.custom_minimum_size = Vector2(640, 420)
	_help_text.selection_enabled = true
	_help.add_child(_help_text)
	add_child(_help)
	clear()


func clear() -> void:
	_findings = []
	_status = 0
	list.clear()
	_unmark()
	_show()


func show_findings(found: Array, status: int) -> void:
	_findings = _together(found)
	_status = status
	list.clear()
	for one: Dictionary in _findings:
		var kind := BespokeRetarget.get_constant_name("KIND", one.kind).trim_prefix("KIND_")
		var icon: Texture2D
		if has_theme_icon(ICONS[one.severity], &"EditorIcons"):
			icon = get_theme_icon(ICONS[one.severity], &"EditorIcons")
		var title := kind.replace("_", " ").to_lower().capitalize()
		list.add_item(title if one.count == 1 else "%s (%d)" % [title, one.count], icon)
		list.set_item_tooltip(list.item_count - 1, one.message)
	_show()


## Those of one kind as one, with the sentence of the first, the worst first.
func _together(found: Array) -> Array:
	var all := {}
	for one: Dictionary in found:
		var key := [-one.severity, one.kind]
		if not all.has(key):
			all[key] = one.duplicate()
			all[key].elements = []
			all[key].count = 0
		all[key].count += 1
		all[key].elements.append_array(one.elements)
	var rows := all.values()
	rows.sort_custom(func(a: Dictionary, b: Dictionary) -> bool: return a.severity > b.severity)
	for one: Dictionary in rows:
		one.elements = one.elements.slice(0, MOST)
	return rows


func _show() -> void:
	_title.text = "Findings (%d)" % _findings.size() if _findings else ""
	list.visible = not _findings.is_empty()
	_text.visible = false
	what_to_do.visible = not BespokeRetarget.get_help_anchor(_status).is_empty() and _status != BespokeRetarget.STATUS_OK
	visible = list.visible or what_to_do.visible


func _chosen(index: int) -> void:
	var finding: Dictionary = _findings[index]
	_text.text = finding.message
	_text.visible = true
	_unmark()
	marks = Marks.of(finding.elements)
	var selection := EditorInterface.get_selection()
	selection.clear()
	for element: Dictionary in finding.elements:
		var node: Variant = element.get("node")
		if is_instance_valid(node) and node.is_inside_tree():
			selection.add_node(node)


func _unmark() -> void:
	for mark in marks:
		if is_instance_valid(mark):
			mark.queue_free()
	marks = []


func _show_help() -> void:
	_help_text.text = help(_status)
	_help.popup_centered()


## The section of docs/troubleshooting.md about a status.
static func help(status: int) -> String:
	var anchor := BespokeRetarget.get_help_anchor(status)
	var wanted := anchor.get_slice("#", 1)
	var lines := PackedStringArray()
	var is_in := false
	for line in FileAccess.get_file_as_string("res://addons/bespoke/docs/" + anchor.get_slice("#", 0)).split("\n"):
		if line.begins_with("## "):
			is_in = line.trim_prefix("## ").to_lower() == wanted
		elif is_in:
			lines.append(line)
	var text := "\n".join(lines).strip_edges().replace("[", "[lb]")
	# Lines of a paragraph belong together; lists and quotes begin anew.
	text = RegEx.create_from_string("\\n(?=[^\\n>\\-0-9 ])|\\n +").sub(text.replace("\n\n", "\u2029"), " ", true)
	text = text.replace("\u2029", "\n\n").replace("> ", "")
	return RegEx.create_from_string("`([^`]*)`").sub(text, "[code]$1[/code]", true)
