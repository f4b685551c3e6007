@tool
extends VBoxContainer
## What the library has to say. One that is chosen is shown in the viewport, and its node is selected.

const Marks := preload("marks.gd")
const Help := preload("help.gd")
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
## The one that is chosen; empty for none.
var _selected := {}


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
	_selected = {}
	_status = 0
	list.clear()
	_unmark()
	_show()


func show_findings(found: Array, status: int) -> void:
	_findings = _together(found)
	_selected = {}
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
	what_to_do.visible = not _anchor().is_empty()
	visible = list.visible or what_to_do.visible


func _chosen(index: int) -> void:
	var finding: Dictionary = _findings[index]
	_selected = finding
	_text.text = finding.message
	_text.visible = true
	what_to_do.visible = not _anchor().is_empty()
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


## The section about what is chosen, or about the whole run.
func _anchor() -> String:
	return Help.of_finding(_selected, _status) if _selected else Help.of_status(_status)


func _show_help() -> void:
	_help_text.text = Help.text(_anchor(), _selected.get("message", ""))
	_help.popup_centered()
