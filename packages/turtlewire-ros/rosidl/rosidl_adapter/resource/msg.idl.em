@{from rosidl_adapter.idl import idl_text}@
@(idl_text("msg", pkg_name, relative_input_file, [msg]))@
