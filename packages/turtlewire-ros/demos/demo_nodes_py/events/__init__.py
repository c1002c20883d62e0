"""Events of endpoints: who matches whom."""
