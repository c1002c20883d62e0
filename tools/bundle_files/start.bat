@echo off
rem Installs turtlewire from this folder, without a network, and runs the demo.
cd /d "%~dp0"
py -3 start.py %*
if errorlevel 1 pause
