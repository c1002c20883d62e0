@{from rosidl_adapter.idl import idl_text}@
@(idl_text("action", pkg_name, relative_input_file, [action.goal, action.result, action.feedback]))@
