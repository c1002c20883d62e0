def main():
    print("sliders")
