package com.hoho.android.usbserial.driver;

import android.hardware.usb.UsbManager;
import java.util.List;

// Declared from the library's documented API, to compile against; the Gradle build takes the library itself.
public class UsbSerialProber {
    public static UsbSerialProber getDefaultProber() {
        throw new UnsupportedOperationException("declaration only");
    }

    public List<UsbSerialDriver> findAllDrivers(UsbManager manager) {
        throw new UnsupportedOperationException("declaration only");
    }
}
