@{from rosidl_adapter.idl import idl_text}@
@(idl_text("srv", pkg_name, relative_input_file, [srv.request, srv.response]))@
