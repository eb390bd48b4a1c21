"""Chromium without a window, for tests of pages."""
import shutil


class Missing(Exception):
    """There is no browser; the text says what is missing."""


def open_browser(width=1200, height=900, is_phone=False, is_dark=False, has_webgl=True):
    """Returns a driver of headless Chromium with WebGL by software."""
    try:
        from selenium import webdriver
    except ImportError:
        raise Missing("there is no selenium (Debian's python3-selenium)")
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if not chromium or not driver:
        raise Missing("there is no chromium and chromedriver (Debian's chromium, chromium-driver)")
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader",
                     "--enable-unsafe-swiftshader", "--hide-scrollbars", "--disable-dev-shm-usage",
                     f"--window-size={width},{height}"):
        options.add_argument(argument)
    if not has_webgl:
        options.add_argument("--disable-3d-apis")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.chrome.service.Service(driver)
    browser = webdriver.Chrome(options=options, service=service)
    browser.set_script_timeout(60)
    browser.set_page_load_timeout(120)
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": is_phone})
    if is_dark:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": "dark"}]})
    return browser


def complaints(browser):
    """Returns what the console of the page has said so far: errors, warnings and refused requests."""
    lines = [entry["message"] for entry in browser.get_log("browser") if entry["level"] != "INFO"]
    # Only tests read pixels back.
    return [line for line in lines
            if "GPU stall due to ReadPixels" not in line and "willReadFrequently" not in line]
