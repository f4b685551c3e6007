# The editor's help says everything that the class has, and nothing else. data/BespokeRetarget.xml is what it is made of.
extends Checks

## What is said of each method, signal and property: its parameters.
var _said := {"method": {}, "signal": {}, "member": {}}
var _texts := {}


func _read() -> bool:
	var parser := XMLParser.new()
	if not holds(parser.open(data.path_join("BespokeRetarget.xml")) == OK, "there is no text"):
		return false
	var kind := ""
	var name := ""
	while parser.read() == OK:
		if parser.get_node_type() == XMLParser.NODE_TEXT and not name.is_empty():
			_texts[name] = _texts.get(name, "") + parser.get_node_data().strip_edges()
		if parser.get_node_type() != XMLParser.NODE_ELEMENT:
			continue
		var element := parser.get_node_name()
		if element in _said:
			kind = element
			name = parser.get_named_attribute_value("name")
			_said[kind][name] = []
		elif element == "param":
			_said[kind][name].append(parser.get_named_attribute_value("name"))
	return true


func test_help_is_whole() -> void:
	if not _read():
		return
	var members := {}
	var hidden := {}
	for property in ClassDB.class_get_property_list("BespokeRetarget", true):
		if property.usage & PROPERTY_USAGE_STORAGE or property.usage & PROPERTY_USAGE_SCRIPT_VARIABLE or property.usage == 0:
			members[property.name] = []
			hidden["get_" + property.name] = true
			hidden["set_" + property.name] = true
	var methods := {}
	for method in ClassDB.class_get_method_list("BespokeRetarget", true):
		if not method.name.begins_with("_") and not method.name in hidden:
			methods[method.name] = method.args.map(func(argument: Dictionary) -> String: return argument.name)
	var signals := {}
	for one in ClassDB.class_get_signal_list("BespokeRetarget", true):
		signals[one.name] = one.args.map(func(argument: Dictionary) -> String: return argument.name)
	holds(methods.size() > 30 and signals.size() == 3 and members.size() == 4, "the class has %s" % [[methods, signals, members]])
	for pair: Array in [["method", methods], ["signal", signals], ["member", members]]:
		var there: Dictionary = pair[1]
		for name: String in there:
			if holds(name in _said[pair[0]], "%s %s is not in the help" % [pair[0], name]):
				same(str(_said[pair[0]][name]), str(there[name]), "the parameters of " + name)
			holds(_texts.get(name, "").length() > 15, "the help says nothing of " + name)
		for name: String in _said[pair[0]]:
			holds(name in there, "%s %s is in the help only" % [pair[0], name])
