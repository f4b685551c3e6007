@tool
extends VBoxContainer
## Which bones correspond, as a table in which the avatar's can be chosen.

## A bone was chosen by hand.
signal changed
## The table is to be filled.
signal asked

const NONE := "(none)"
## Below this it is a guess.
const SURE := 0.5

## What was chosen by hand: names of bones of the garment's skeleton, and those of the avatar's, empty for none.
var pairs := {}
var show := Button.new()
var forget := Button.new()
var table := Tree.new()
var _about := Label.new()
var _bones := PackedStringArray()


func _init() -> void:
	var row := HBoxContainer.new()
	show.text = "Matching bones"
	show.toggle_mode = true
	show.flat = true
	show.alignment = HORIZONTAL_ALIGNMENT_LEFT
	show.size_flags_horizontal = SIZE_EXPAND_FILL
	show.tooltip_text = "Which bones of the two skeletons correspond. Choose another one where it is wrong."
	show.toggled.connect(_toggled)
	row.add_child(show)
	forget.text = "Find out again"
	forget.tooltip_text = "Forgets what was chosen by hand."
	forget.pressed.connect(_forget)
	row.add_child(forget)
	add_child(row)
	table.columns = 3
	table.column_titles_visible = true
	table.hide_root = true
	table.custom_minimum_size.y = 320
	for column in 3:
		table.set_column_title(column, ["Garment", "Avatar", "Sure"][column])
		table.set_column_title_alignment(column, HORIZONTAL_ALIGNMENT_LEFT)
		table.set_column_expand(column, column < 2)
		table.set_column_clip_content(column, true)
	table.set_column_expand_ratio(1, 2)
	table.set_column_custom_minimum_width(2, 52)
	table.item_edited.connect(_edited)
	table.item_selected.connect(_selected)
	add_child(table)
	_about.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	add_child(_about)
	clear()


## Other characters, other bones.
func clear() -> void:
	pairs = {}
	show.set_pressed_no_signal(false)
	_show_table(false)


## Fills the table. `bones` are those of the avatar.
func show_map(map: Array[Dictionary], bones: PackedStringArray) -> void:
	_bones = bones
	var chosen := table.get_selected()
	var kept: String = chosen.get_text(0) if chosen else ""
	var scroll := table.get_scroll()
	table.clear()
	var prefix := _prefix(bones)
	var choices := NONE
	for bone in bones:
		# The names stand between commas.
		choices += "," + bone.trim_prefix(prefix).replace(",", ";")
	var root := table.create_item()
	for joint in map:
		var item := table.create_item(root)
		item.set_text(0, joint.source)
		item.set_tooltip_text(0, joint.part)
		item.set_cell_mode(1, TreeItem.CELL_MODE_RANGE)
		item.set_text(1, choices)
		item.set_range(1, bones.find(joint.target) + 1)
		item.set_tooltip_text(1, joint.target)
		item.set_editable(1, true)
		item.set_text(2, "by hand" if pairs.has(joint.source) else "%d %%" % roundi(100 * joint.confidence))
		if joint.reason == BespokeRetarget.REASON_NOTHING and not pairs.has(joint.source):
			item.set_text(2, "–")
		elif joint.confidence < SURE and joint.reason != BespokeRetarget.REASON_ANCESTOR:
			if has_theme_color(&"warning_color", &"Editor"):
				for column in 3:
					item.set_custom_color(column, get_theme_color(&"warning_color", &"Editor"))
		item.set_metadata(0, joint)
		if joint.source == kept:
			item.select(0)
	table.set_deferred(&"scroll", scroll)
	show.set_pressed_no_signal(true)
	_show_table(true)


## What all names begin with, up to a mark such as that of mixamorig_Hips: it only takes room.
static func _prefix(bones: PackedStringArray) -> String:
	if bones.size() < 2:
		return ""
	var end := maxi(bones[0].rfind("_"), bones[0].rfind(":"))
	var prefix := bones[0].substr(0, end + 1)
	for bone in bones:
		if not bone.begins_with(prefix):
			return ""
	return prefix


func _toggled(is_open: bool) -> void:
	if is_open:
		show.set_pressed_no_signal(false)
		asked.emit()
	else:
		_show_table(false)


func _notification(what: int) -> void:
	if what == NOTIFICATION_THEME_CHANGED:
		_show_table(table.visible)


func _show_table(is_shown: bool) -> void:
	var arrow := &"GuiTreeArrowDown" if is_shown else &"GuiTreeArrowRight"
	if has_theme_icon(arrow, &"EditorIcons"):
		show.icon = get_theme_icon(arrow, &"EditorIcons")
	table.visible = is_shown
	_about.visible = is_shown and not _about.text.is_empty()
	forget.visible = is_shown and not pairs.is_empty()


func _edited() -> void:
	var item := table.get_edited()
	var choice := int(item.get_range(1))
	var bone := _bones[choice - 1] if choice > 0 else ""
	# Each bone of the avatar is in one pair.
	for other: String in pairs.keys():
		if bone and pairs[other] == bone:
			pairs.erase(other)
	pairs[item.get_text(0)] = bone
	changed.emit.call_deferred()


func _selected() -> void:
	var joint: Dictionary = table.get_selected().get_metadata(0)
	var reason := BespokeRetarget.get_constant_text("REASON", joint.reason)
	_about.text = "%s: %s" % [joint.part.capitalize(), reason] if joint.part else reason
	_about.visible = true


func _forget() -> void:
	pairs = {}
	changed.emit()
