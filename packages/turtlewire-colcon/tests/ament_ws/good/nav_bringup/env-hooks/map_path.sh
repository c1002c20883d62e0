ament_prepend_unique_value NAV_MAP_PATH "$AMENT_CURRENT_PREFIX/share/nav_bringup/maps"
